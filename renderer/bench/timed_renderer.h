// Renderers under the clock: frames are timed in turn, one of each renderer a round, so that whatever else the machine does
// slows all alike.
#pragma once

#include <functional>
#include <vector>

#include "renderer/bench/configuration.h"
#include "renderer/shadow_renderer.h"

namespace stairstep::bench {

/// A scene on the GPU, in the state that is measured.
struct Subject {
    const GpuScene& scene;
    const SceneState& state;
    /// Of constant filters, world units.
    double radius = 0;
};

/// Median times of a pass, ms: between two waits for the GPU, and by its own clock.
struct MedianTime {
    double cpu_ms = 0;
    double gpu_ms = 0;
};

/// Of a frame and of its passes (FrameTime).
struct MedianTimes {
    /// Of the whole frame, the fit among it.
    MedianTime frame;
    MedianTime depth;
    MedianTime prepare;
    MedianTime surfaces;
    MedianTime lighting;
    MedianTime need;
    double fit_ms = 0;
    /// Of the processor in this process, all threads together: what a frame of a software renderer costs whatever else the
    /// machine does.
    double processor_ms = 0;
};

struct TimedRenderer {
    Configuration configuration;
    ShadowRenderer renderer;
    Subject subject;
    const FrameTarget& target;
    std::vector<FrameTime> times{};
    /// Processor time of each.
    std::vector<double> processor_ms{};
};

/// Each figure's own median; of one frame or more.
MedianTimes median_times(const TimedRenderer& timed);

/// Draws `frames` rounds, each a frame of every renderer, and appends the times. `advance` is called after each frame.
/// Throws FailureError.
void time_in_turn(std::vector<TimedRenderer>& group, int frames, const std::function<void()>& advance);

}  // namespace stairstep::bench
