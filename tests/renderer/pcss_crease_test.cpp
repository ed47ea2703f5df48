// Percentage-closer soft shadows where the blockers around a penumbra lie at very different depths, against rays traced to
// the light: creases mustn't darken themselves, and what is small and near must be found beside what is tall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/gl/context.h"
#include "renderer/truth/area_light_truth.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

class PcssCrease : public testing::Test {
  protected:
    static std::vector<float> draw(const Scene& scene, const SceneState& state, int side = 1024) {
        ShadowSettings settings;
        settings.technique.filter = FilterMode::exact;
        return made::draw_visibility(scene, state, "pcss", settings,
                                     map_of_size(made::fitted(scene, state.light), side), kWidth, kHeight);
    }

    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

/// Walls that rise to both sides of the z axis to a height of 1.
Scene groove(double wall_deg) {
    const auto run = static_cast<float>(1 / std::tan(wall_deg * std::numbers::pi / 180));
    return made::scene_of({made::polygon({{0, 0, -4}, {0, 0, 4}, {run, 1, 4}, {run, 1, -4}}, true),
                           made::polygon({{0, 0, -4}, {0, 0, 4}, {-run, 1, 4}, {-run, 1, -4}}, true)});
}

// Lit along its bisector, each point of a groove sees all of a light that is narrower than the groove: V = 1. A mean of
// blockers from farther off than the penumbra reaches draws it dark.
TEST_F(PcssCrease, AGrooveThatIsWiderThanTheLightIsLit) {
    for (const double wall_deg : {30.0, 45.0, 60.0}) {
        SCOPED_TRACE(wall_deg);
        const double run = 1 / std::tan(wall_deg * std::numbers::pi / 180);
        const Scene scene = groove(wall_deg);
        SceneState state;
        state.camera = made::camera_down({0, 1.5, 0});
        state.light = directional_light({0, 90}, 0.15);
        ASSERT_LT(state.light.half_tangent(), run / 2) << "the walls should stand outside the light's cone";
        const std::vector<float> drawn = draw(scene, state);
        EXPECT_GT(*std::ranges::min_element(drawn), 0.95);
    }
}

// A search as coarse as a tall caster asks for steps over a strip just above the ground.
TEST_F(PcssCrease, AStripBesideAMastThrowsItsShadow) {
    for (const float width : {0.04f, 0.06f}) {
        SCOPED_TRACE(width);
        std::vector<Mesh> meshes = made::box({3, 0, -0.1f}, {3.2f, 6, 0.1f});
        for (int i = 0; i < 3; ++i) {
            const float x = -0.6f + 0.5f * i;
            meshes.push_back(
                made::polygon({{x, 0.03f, -2}, {x, 0.03f, 2}, {x + width, 0.03f, 2}, {x + width, 0.03f, -2}}, true));
        }
        meshes.push_back(made::ground(0, 9));
        const Scene scene = made::scene_of(std::move(meshes));
        SceneState state;
        // The light comes from so far aside that the strips, seen from above, don't hide their shadows.
        state.camera = made::camera_down({0, 1.2, 0});
        state.light = directional_light({90, 40}, 0.1);
        const std::vector<float> truth = area_light_visibility(scene, state, kWidth, kHeight, 256);
        const std::vector<float> drawn = draw(scene, state, 2048);
        int dark = 0;
        int missed = 0;
        for (size_t i = 0; i < truth.size(); ++i) {
            dark += truth[i] == 0;
            missed += truth[i] == 0 && drawn[i] == 1;
        }
        EXPECT_GT(dark, 300) << "the picture should show the shadows";
        EXPECT_LT(missed, dark / 20);
    }
}

}  // namespace
}  // namespace stairstep
