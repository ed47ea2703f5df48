// Percentage-closer soft shadows on whole scenes against the truth: maps that size themselves are no worse than large ones.
#include <gtest/gtest.h>

#include "renderer/comparison.h"
#include "renderer/gl/context.h"
#include "renderer/scenes/scenes.h"
#include "renderer/shadow_renderer.h"
#include "renderer/techniques/techniques.h"
#include "renderer/truth/area_light_truth.h"

namespace stairstep {
namespace {

// A smaller picture shows less, and gets a smaller map: at a quarter of this width its pixels, not the map, decide the error.
constexpr int kWidth = 1280;
constexpr int kHeight = 720;

class PcssTruth : public testing::TestWithParam<const char*> {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

struct Drawn {
    VisibilityError error;
    ShadowMapShape shape;
};

Drawn draw(const AnimatedScene& animated, const SceneState& state, const ShadowSettings& settings,
           const std::vector<float>& truth) {
    const GpuScene gpu = upload(animated.scene);
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    ShadowRenderer renderer(technique_named("pcss"), settings, gpu, state, static_cast<double>(kWidth) / kHeight);
    gl::PassTimer timer;
    renderer.draw(gpu, state, target, timer);
    return {compare_visibility(read_visibility(target), truth), renderer.map().shape};
}

TEST_P(PcssTruth, AutoIsNoWorseThanALargeFixedMap) {
    const AnimatedScene animated = scene_named(GetParam());
    const SceneState state = animated.state(Motion::still, 0);
    const std::vector<float> truth = area_light_visibility(animated.scene, state, kWidth, kHeight, 64);
    ShadowSettings settings;
    settings.radius = animated.radius;
    settings.largest_size = 4096;
    const Drawn sized = draw(animated, state, settings, truth);
    settings.fixed_size = 4096;
    settings.technique.filter = FilterMode::rotated;
    const Drawn fixed = draw(animated, state, settings, truth);
    EXPECT_GT(sized.error.penumbra_share, 0.01) << "the picture should show penumbras";
    EXPECT_LE(sized.error.rmse, fixed.error.rmse)
        << "in penumbras " << sized.error.penumbra_rmse << " and " << fixed.error.penumbra_rmse << ", on maps of "
        << sized.shape.width << " × " << sized.shape.height << " and 4096²";
    EXPECT_LE(sized.error.penumbra_rmse, fixed.error.penumbra_rmse);
    EXPECT_LT(sized.shape.texel_count(), fixed.shape.texel_count());
}

INSTANTIATE_TEST_SUITE_P(Of, PcssTruth, testing::Values("clutter", "colonnade", "cornell", "crane"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace stairstep
