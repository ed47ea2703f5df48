#include "renderer/gl/pass_timer.h"

#include <algorithm>
#include <cassert>

namespace stairstep::gl {
namespace {

/// The innermost pass being timed in this thread.
constinit thread_local PassTimer* innermost = nullptr;

double ms(std::chrono::steady_clock::duration time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

}  // namespace

void PassTimer::start() {
    give_up();
    if (innermost) innermost->end_part();
    outer_ = innermost;
    innermost = this;
    gpu_ms_ = 0;
    Finish();
    start_ = Clock::now();
    begin_part();
}

PassTime PassTimer::stop() {
    assert(innermost == this);
    end_part();
    const PassTime time{ms(Clock::now() - start_), gpu_ms_};
    if (outer_) outer_->gpu_ms_ += gpu_ms_;
    leave();
    return time;
}

void PassTimer::begin_part() {
    part_start_ = Clock::now();
    BeginQuery(GL_TIME_ELAPSED, query_.id());
}

void PassTimer::end_part() {
    EndQuery(GL_TIME_ELAPSED);
    Finish();
    const double elapsed_ms = ms(Clock::now() - part_start_);
    GLuint64 elapsed_ns = 0;
    GetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &elapsed_ns);
    // llvmpipe answers with the machine's uptime for a pass in which it draws no triangle.
    gpu_ms_ += std::min(static_cast<double>(elapsed_ns) * 1e-6, elapsed_ms);
}

void PassTimer::leave() {
    innermost = outer_;
    outer_ = nullptr;
    if (innermost) innermost->begin_part();
}

void PassTimer::give_up() {
    if (innermost != this) return;
    EndQuery(GL_TIME_ELAPSED);
    leave();
}

}  // namespace stairstep::gl
