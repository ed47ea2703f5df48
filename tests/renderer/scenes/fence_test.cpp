// The fence's shadow against the closed forms of its grating: what it should be, and how far off a map's texels draw it.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/law/grating_error.h"
#include "renderer/gl/context.h"
#include "renderer/scenes/scenes.h"
#include "renderer/shadow_renderer.h"
#include "renderer/techniques/techniques.h"

namespace stairstep {
namespace {

/// As fence.cpp has them: pales stand from x = −6 on.
constexpr Grating kGrating{0.03, 0.06};
constexpr double kLeft = -6;
constexpr double kSlope = 3.47;
constexpr int kWidth = 6400;
constexpr int kHeight = 4;
/// Of the ground that is looked at: 9 m along the middle of the shadow.
constexpr double kHalfSeen = 4.5;
constexpr double kEyeHeight = 20;

/// From straight above, where nothing of the fence is in the way.
Camera camera_above() {
    const glm::dvec3 middle(-0.4, 0, 1.65);
    Camera camera;
    camera.basis = basis_towards({0, 90});
    camera.eye = middle + glm::dvec3(0, kEyeHeight, 0);
    const double half_height = kHalfSeen * kHeight / kWidth;
    camera.vertical_fov_deg = 2 * std::atan(half_height / kEyeHeight) * 180 / std::numbers::pi;
    camera.near = 1;
    camera.far = 40;
    return camera;
}

/// Light through the grating from the first pale's left side to x.
double light_to(double x) {
    const double t = x - kLeft;
    const double periods = std::floor(t / kGrating.period);
    return periods * kGrating.gap + std::max(0.0, t - periods * kGrating.period - (kGrating.period - kGrating.gap));
}

double true_visibility(double x, double radius) {
    return (light_to(x + radius) - light_to(x - radius)) / (2 * radius);
}

struct Drawn {
    double rmse = 0;
    double texel = 0;
};

class Fence : public testing::Test {
  protected:
    /// In a map of texels that are so many times smaller than the law's; of a pixel, 1.4 mm, at least.
    Drawn draw(double radius, double finer) {
        SceneState state = animated_.state(Motion::still, 0);
        state.camera = camera_above();
        ShadowSettings settings;
        settings.technique.filter = FilterMode::exact;
        settings.technique.law_slope = kSlope * finer;
        settings.radius = radius;
        ShadowRenderer renderer(technique_named("pcf"), settings, gpu_, state, static_cast<double>(kWidth) / kHeight);
        const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
        gl::PassTimer timer;
        renderer.draw(gpu_, state, target, timer);
        const std::vector<float> visibility = read_visibility(target);
        double sum = 0;
        for (size_t i = 0; i < visibility.size(); ++i) {
            const double along = (static_cast<double>(i % kWidth) + 0.5) / kWidth * 2 - 1;
            const double x = state.camera.eye.x + along * kHalfSeen;
            const double error = visibility[i] - true_visibility(x, radius);
            sum += error * error;
        }
        return {std::sqrt(sum / static_cast<double>(visibility.size())), renderer.map().shape.texel().x};
    }

    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
    const AnimatedScene animated_ = scene_named("fence");
    const GpuScene gpu_ = upload(animated_.scene);
};

// Half of the light, where a filter takes in whole periods.
TEST_F(Fence, LetsHalfOfTheLightThrough) {
    for (const double x : {-4.0, 0.0, 3.0}) EXPECT_NEAR(true_visibility(x, 2.5 * kGrating.period), 0.5, 1e-9);
}

// At the law's size and at finer ones, from 0.6 to 28 texels a period. All phases of pales and texels occur along the fence but where
// a period is close to a texel, whose beats are long: 1.4 m at a radius of 0.2.
TEST_F(Fence, TexelsErrAsSamplingTheoryHasIt) {
    const auto expect_as_expected = [](const Drawn& drawn, double radius) {
        const double expected = grating_rmse(kGrating, drawn.texel, radius);
        EXPECT_NEAR(drawn.rmse, expected, 0.03 * expected + 0.001)
            << "radius " << radius << ", " << kGrating.period / drawn.texel << " texels a period";
    };
    for (const double radius : {0.03, 0.05, 0.08, 0.15, 0.185, 0.2, 0.23, 0.33}) {
        for (const double finer : {1.0, 2.0}) expect_as_expected(draw(radius, finer), radius);
        if (radius < 0.1) expect_as_expected(draw(radius, 8), radius);
    }
}

TEST_F(Fence, ManyTexelsDrawItAsItIs) {
    EXPECT_LT(draw(0.05, 8).rmse, 0.01);
}

// At the scene's own radius the law's map draws beats of the texels instead of the fence; half of that texel none.
TEST_F(Fence, TheLawsTexelsBeatWithItsPales) {
    EXPECT_GT(draw(animated_.radius, 1).rmse, 0.35);
    EXPECT_LT(draw(animated_.radius, 2).rmse, 0.04);
}

}  // namespace
}  // namespace stairstep
