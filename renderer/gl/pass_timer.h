// How long a pass takes, measured twice: on the CPU's clock from an idle GPU until it is idle again (what a
// user waits for), and by the driver's own timer query (what the GPU worked).
#pragma once

#include <chrono>

#include "renderer/gl/objects.h"

namespace stairstep::gl {

struct PassTime {
    /// Between two glFinish, ms.
    double cpu_ms = 0;
    /// GL_TIME_ELAPSED, ms; never above cpu_ms.
    double gpu_ms = 0;

    PassTime& operator+=(const PassTime& other) {
        cpu_ms += other.cpu_ms;
        gpu_ms += other.gpu_ms;
        return *this;
    }
};

/// Times one pass after another: start, draw, stop. A pass may hold others, each with its own timer, last started first
/// stopped; its times include theirs. GL has one time query at a time: the outer's is cut in two around the inner's,
/// which leaves the GPU idle at both ends. A timer that goes without stop, as when drawing throws, gives up its pass.
class PassTimer {
  public:
    PassTimer() : query_(make_timer_query()) {}
    ~PassTimer() { give_up(); }
    PassTimer(const PassTimer&) = delete;
    PassTimer& operator=(const PassTimer&) = delete;

    /// Starts over if the last pass wasn't stopped.
    void start();
    PassTime stop();

  private:
    using Clock = std::chrono::steady_clock;

    void begin_part();
    void end_part();
    void leave();
    void give_up();

    Query query_;
    Clock::time_point start_;
    Clock::time_point part_start_;
    /// Of the parts so far.
    double gpu_ms_ = 0;
    /// The timer whose pass this one's is in, while running.
    PassTimer* outer_ = nullptr;
};

}  // namespace stairstep::gl
