#include "renderer/bench/wobble.h"

namespace stairstep::bench {

MotionWobble wobble_of(const Configuration& configuration, const MeasurementSettings& settings,
                       const WobbleSettings& wobble, const AnimatedScene& animated, const GpuScene& scene,
                       double radius, SceneTruth& truth) {
    MeasurementSettings small = settings;
    small.width = wobble.width;
    small.height = wobble.height;
    const FrameTarget target = make_frame_target(Show::visibility, wobble.width, wobble.height, 1);
    const SceneState start = animated.state(Motion::still, 0);
    const TruthKind kind = truth_of(configuration);
    gl::PassTimer timer;
    const auto over = [&](Motion motion) {
        ShadowRenderer renderer = settled_renderer(configuration, small, {scene, start, radius}, target);
        Wobble moving;
        for (int i = 0; i <= wobble.steps; ++i) {
            const SceneState state = animated.state(motion, i * kWobbleStep);
            renderer.draw(scene, state, target, timer);
            moving.add(read_visibility(target), truth.visibility(kind, state));
        }
        return moving.mean();
    };
    return {over(Motion::light), over(Motion::caster), over(Motion::camera)};
}

}  // namespace stairstep::bench
