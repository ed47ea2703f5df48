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
constexpr int kWidth = 1600;
constexpr int kHeight = 8;
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
    /// With the law's map, or one of texels so many times smaller.
    Drawn draw(double radius, double finer) {
        SceneState state = animated_.state(Motion::still, 0);
        state.camera = camera_above();
        ShadowSettings settings;
        settings.technique.law_slope = kSlope * finer;
        settings.radius = radius;
        settings.technique.filter = FilterMode::exact;
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

TEST_F(Fence, ManyTexelsDrawItAsItIs) {
    for (double f : {1.0, 2.0, 4.0, 6.0, 8.0, 10.0,  12.0, 14.0, 16.0}) { const Drawn d = draw(0.05, f); std::cerr << f << " " << d.rmse << " " << d.texel << " " << grating_rmse(kGrating, d.texel, 0.05) << "\n"; }
}

// At the law's size and at others, from 0.6 to 7 texels a period: all phases of texels and pales occur along the fence.
TEST_F(Fence, TexelsErrAsSamplingTheoryHasIt) {
    for (const double radius : {0.03, 0.05, 0.08, 0.15, 0.185, 0.2, 0.23, 0.33}) {
        for (const double finer : {1.0, 2.0}) {
            const Drawn drawn = draw(radius, finer);
            const double expected = grating_rmse(kGrating, drawn.texel, radius);
            EXPECT_NEAR(drawn.rmse, expected, 0.1 * expected + 0.004)
                << "radius " << radius << ", " << kGrating.period / drawn.texel << " texels a period"; std::cerr << radius << " " << finer << " " << drawn.rmse << " " << expected << "\n";
        }
    }
}

}  // namespace
}  // namespace stairstep
