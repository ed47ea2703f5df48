// How much a configuration's shadows move where the true ones don't, over a scene's motions.
#pragma once

#include <functional>

#include "renderer/bench/measurement.h"
#include "renderer/scene_state.h"

namespace stairstep::bench {

struct WobbleSettings {
    /// Steps of each motion, ≥ 1; a step is 1/200 of it.
    int steps = 8;
    /// Of the pictures, px.
    int width = 320;
    int height = 180;
    TruthSettings truth;
};

inline constexpr double kWobbleStep = 1.0 / 200;

/// Wobble's mean (comparison.h), of visibility, over each motion. The map settles before it and then follows it, a frame a
/// step. Throws FailureError.
MotionWobble wobble_of(const Configuration& configuration, const MeasurementSettings& settings,
                       const WobbleSettings& wobble, const AnimatedScene& animated, const GpuScene& scene,
                       double radius, SceneTruth& truth);

}  // namespace stairstep::bench
