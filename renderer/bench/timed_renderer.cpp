#include "renderer/bench/timed_renderer.h"

#include <ctime>

#include "renderer/frame_median.h"

namespace stairstep::bench {
namespace {

MedianTime median_pass(const std::vector<FrameTime>& times, gl::PassTime FrameTime::*pass) {
    return {median_of(times, [=](const FrameTime& t) { return (t.*pass).cpu_ms; }),
            median_of(times, [=](const FrameTime& t) { return (t.*pass).gpu_ms; })};
}

double processor_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace

MedianTimes median_times(const TimedRenderer& timed) {
    const std::vector<FrameTime>& times = timed.times;
    MedianTimes median;
    median.frame = {median_of(times, [](const FrameTime& t) { return t.cpu_ms(); }),
                    median_of(times, [](const FrameTime& t) { return t.gpu_ms(); })};
    median.depth = median_pass(times, &FrameTime::depth);
    median.prepare = median_pass(times, &FrameTime::prepare);
    median.surfaces = median_pass(times, &FrameTime::surfaces);
    median.lighting = median_pass(times, &FrameTime::lighting);
    median.need = median_pass(times, &FrameTime::need);
    median.fit_ms = median_of(times, [](const FrameTime& t) { return t.fit_ms; });
    median.processor_ms = stairstep::median(timed.processor_ms);
    return median;
}

void time_in_turn(std::vector<TimedRenderer>& group, int frames, const std::function<void()>& advance) {
    gl::PassTimer timer;
    for (int i = 0; i < frames; ++i) {
        for (TimedRenderer& timed : group) {
            const double before = processor_ms();
            timed.times.push_back(timed.renderer.draw(timed.subject.scene, timed.subject.state, timed.target, timer));
            timed.processor_ms.push_back(processor_ms() - before);
            advance();
        }
    }
}

}  // namespace stairstep::bench
