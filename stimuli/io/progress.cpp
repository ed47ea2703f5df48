#include "stimuli/io/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace stairstep {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kSilentFor = std::chrono::seconds(1);
constexpr auto kBetweenDraws = std::chrono::milliseconds(100);
constexpr int kBarWidth = 30;

}  // namespace

Progress::Progress(std::string label, long total)
    : label_(std::move(label)),
      total_(std::max(total, 0L)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      next_draw_(start_ + kSilentFor) {}

Progress::~Progress() {
    // The bar was for the wait: clear it, so that what follows starts on a clean line.
    if (drawn_) std::fprintf(stderr, "\r\033[K");
}

void Progress::advance(long units) {
    const long done = done_ += units;
    if (!terminal_) return;
    const std::unique_lock lock(drawing_, std::try_to_lock);
    if (!lock || Clock::now() < next_draw_) return;
    draw(done);
    next_draw_ = Clock::now() + kBetweenDraws;
}

void Progress::draw(long done) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    const double rate = done / seconds;
    drawn_ = true;
    if (total_ == 0) {
        std::fprintf(stderr, "\r\033[K%s  %ld  %.0f/s", label_.c_str(), done, rate);
        return;
    }
    const int filled = static_cast<int>(std::min(done, total_) * kBarWidth / total_);
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    std::fprintf(stderr, "\r\033[K%s [%s] %ld/%ld  %.0f/s  %.0f s left", label_.c_str(), bar.c_str(), done, total_,
                 rate, rate > 0 ? (total_ - done) / rate : 0.0);
}

}  // namespace stairstep
