#include "renderer/stimulus_source.h"

#include <condition_variable>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "renderer/gl/context.h"
#include "renderer/stimulus_renderer.h"

namespace stairstep {
namespace {

/// The thread that draws. What it owns of GL lives and dies there.
class DrawingThread {
  public:
    std::vector<double> luminance(const Stimulus& stimulus) {
        Task task([&stimulus](Gl& gl) { return gl.luminance(stimulus); });
        std::future<std::vector<double>> drawn = task.get_future();
        {
            const std::scoped_lock lock(guard_);
            tasks_.push_back(std::move(task));
        }
        arrived_.notify_one();
        return drawn.get();
    }

  private:
    /// Made by the first task, so that whoever asked for it gets what it throws.
    struct Gl {
        std::unique_ptr<gl::Context> context;
        std::optional<StimulusRenderer> renderer;

        std::vector<double> luminance(const Stimulus& stimulus) {
            if (!context) context = gl::make_osmesa_context();
            if (!renderer) renderer.emplace();
            return renderer->luminance(stimulus);
        }
    };
    using Task = std::packaged_task<std::vector<double>(Gl&)>;

    void work(const std::stop_token& stop) {
        Gl gl;
        std::unique_lock lock(guard_);
        while (arrived_.wait(lock, stop, [this] { return !tasks_.empty(); })) {
            Task task = std::move(tasks_.front());
            tasks_.pop_front();
            lock.unlock();
            task(gl);
            lock.lock();
        }
    }

    std::mutex guard_;
    std::condition_variable_any arrived_;
    std::deque<Task> tasks_;
    // Last: it starts when all else is there, and ends first.
    std::jthread thread_{[this](const std::stop_token& stop) { work(stop); }};
};

}  // namespace

LuminanceOf shadow_map_source() {
    return [thread = std::make_shared<DrawingThread>()](const Stimulus& stimulus) {
        return stimulus.pattern == Pattern::line ? luminance(stimulus) : thread->luminance(stimulus);
    };
}

}  // namespace stairstep
