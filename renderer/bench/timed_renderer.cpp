#include "renderer/bench/timed_renderer.h"

#include "renderer/frame_median.h"

namespace stairstep::bench {
namespace {

MedianTime median_pass(const std::vector<FrameTime>& times, gl::PassTime FrameTime::*pass) {
    return {median_of(times, [=](const FrameTime& t) { return (t.*pass).cpu_ms; }),
            median_of(times, [=](const FrameTime& t) { return (t.*pass).gpu_ms; })};
}

}  // namespace

MedianTimes median_times(const std::vector<FrameTime>& times) {
    MedianTimes median;
    median.frame = {
        median_of(times, [](const FrameTime& t) { return t.cpu_ms(); }), median_of(times, [](const FrameTime& t) {
            return t.depth.gpu_ms + t.prepare.gpu_ms + t.surfaces.gpu_ms + t.lighting.gpu_ms + t.need.gpu_ms;
        })};
    median.depth = median_pass(times, &FrameTime::depth);
    median.prepare = median_pass(times, &FrameTime::prepare);
    median.surfaces = median_pass(times, &FrameTime::surfaces);
    median.lighting = median_pass(times, &FrameTime::lighting);
    median.need = median_pass(times, &FrameTime::need);
    median.fit_ms = median_of(times, [](const FrameTime& t) { return t.fit_ms; });
    return median;
}

void time_in_turn(std::vector<TimedRenderer>& group, int frames, const std::function<void()>& advance) {
    gl::PassTimer timer;
    for (int i = 0; i < frames; ++i) {
        for (TimedRenderer& timed : group) {
            timed.times.push_back(timed.renderer.draw(timed.subject.scene, timed.subject.state, timed.target, timer));
            advance();
        }
    }
}

}  // namespace stairstep::bench
