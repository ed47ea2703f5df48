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
};

/// Times one pass after another: start, draw, stop. Passes can't nest, as GL's time queries can't.
class PassTimer {
  public:
    PassTimer() : query_(make_timer_query()) {}

    void start();
    PassTime stop();

  private:
    Query query_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace stairstep::gl
