#include "renderer/cascades.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/gl/context.h"
#include "renderer/scenes/scenes.h"
#include "renderer/shadow_renderer.h"
#include "renderer/techniques/techniques.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(Splits, AreTheirClosedForms) {
    EXPECT_EQ(split_distances(1, 100, {4, Splits::uniform}), (std::vector<double>{1, 25.75, 50.5, 75.25, 100}));
    // A border that the header names is rounded: √10 and 10·√10 are the logarithmic ones.
    const double root = std::sqrt(10.0);
    const std::vector<double> logarithmic = split_distances(1, 100, {4, Splits::logarithmic});
    const std::vector<double> practical = split_distances(1, 100, {4, Splits::practical});
    const double wanted[]{1, root, 10, 10 * root, 100};
    const double header[]{1, 14.5, 30.25, 53.4, 100};
    for (int i = 0; i < 5; ++i) {
        EXPECT_NEAR(logarithmic[i], wanted[i], 1e-12);
        EXPECT_NEAR(practical[i], (wanted[i] + 1 + 24.75 * i) / 2, 1e-12);
        EXPECT_NEAR(practical[i], header[i], 0.05);
    }
}

TEST(Splits, RiseFromNearToFar) {
    for (const Splits splits : {Splits::uniform, Splits::logarithmic, Splits::practical}) {
        for (const auto& [near, far] :
             std::vector<std::pair<double, double>>{{0.1, 0.7}, {1e-3, 1e5}, {3.3, 3.4}, {0.01, 1000}}) {
            for (int count = 1; count <= 16; ++count) {
                const std::vector<double> borders = split_distances(near, far, {count, splits});
                ASSERT_EQ(borders.size(), static_cast<size_t>(count) + 1);
                EXPECT_EQ(borders.front(), near);
                EXPECT_EQ(borders.back(), far);
                for (int i = 0; i < count; ++i) EXPECT_LT(borders[i], borders[i + 1]);
            }
        }
    }
}

TEST(Splits, HaveNames) {
    EXPECT_EQ(splits_named("uniform"), Splits::uniform);
    EXPECT_EQ(splits_named("logarithmic"), Splits::logarithmic);
    EXPECT_EQ(splits_named("practical"), Splits::practical);
    for (const char* name : {"", "log", "Uniform", "uniform "}) EXPECT_THROW(splits_named(name), InputError) << name;
}

constexpr int kWidth = 160;
constexpr int kHeight = 90;
/// A place in a map of some hundred texels is rounded by some 1e-5 of one, over a filter of 7.
constexpr double kRounding = 1e-5;
/// A texel's share of a box of 2 × 3.47 of them a side, and pixels whose boxes one such texel may lie in.
constexpr double kOneTexel = 1 / (6.94 * 6.94);
constexpr size_t kMostByATexel = kWidth * kHeight / 200;
/// Of a scene's own radius.
constexpr double kWideRadius = 12;

class CascadesOf : public testing::Test {
  protected:
    struct Drawn {
        std::vector<float> visibility;
        std::vector<glm::dvec2> texels;
        std::vector<ShadowMapShape::Limit> limits;
    };

    Drawn draw(const AnimatedScene& animated, const GpuScene& gpu, const SceneState& state, ShadowSettings settings,
               const Cascades& cascades, const Skips& skips = {}) {
        settings.cascades = cascades;
        settings.skips = skips;
        settings.technique.filter = FilterMode::exact;
        if (settings.radius == 0) settings.radius = animated.radius;
        ShadowRenderer renderer(technique_named("pcf"), settings, gpu, state, static_cast<double>(kWidth) / kHeight);
        renderer.draw(gpu, state, target_, timer_);
        Drawn drawn{read_visibility(target_), {}, {}};
        for (const LightShadow& shadow : renderer.shadows()) {
            // A slice without shadows has no texels to speak of.
            if (shadow.map().shape.frustum.shadowless) continue;
            drawn.texels.push_back(shadow.map().shape.texel());
            drawn.limits.push_back(shadow.map().shape.limit);
        }
        return drawn;
    }

    /// Each pixel's distance along the view in the picture last drawn, row by row from the top.
    std::vector<double> view_distances(const Camera& camera) {
        std::vector<float> depths(static_cast<size_t>(kWidth) * kHeight);
        gl::GetTextureImage(target_.depth.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                            static_cast<GLsizei>(depths.size() * sizeof(float)), depths.data());
        std::vector<double> distances;
        for (int row = kHeight; row-- > 0;) {
            for (int column = 0; column < kWidth; ++column) {
                // 1 at the near plane, 0 at the far one, linear in the reciprocal.
                const double depth = depths[static_cast<size_t>(row) * kWidth + column];
                distances.push_back(camera.near * camera.far / (depth * (camera.far - camera.near) + camera.near));
            }
        }
        return distances;
    }

    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
    FrameTarget target_ = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    gl::PassTimer timer_;
};

double worst_difference(const std::vector<float>& a, const std::vector<float>& b) {
    double worst = 0;
    for (size_t i = 0; i < a.size(); ++i) worst = std::max<double>(worst, std::abs(a[i] - b[i]));
    return worst;
}

size_t differing(const std::vector<float>& a, const std::vector<float>& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > kRounding;
    return count;
}

// All pixels, those along the borders among them, come from the same texels. But for one here and there whose centre lies right on a
// caster's edge: maps that begin elsewhere round it to its other side, and a pixel's box has it as one of its (2c)².
TEST_F(CascadesOf, ShowNoSeamUnderTheLaw) {
    for (const char* name : {"colonnade", "crane", "clutter"}) {
        const AnimatedScene animated = scene_named(name);
        const GpuScene gpu = upload(animated.scene);
        for (const double t : {0.0, 0.6}) {
            const SceneState state = animated.state(Motion::camera, t);
            ShadowSettings settings;
            // So wide that the law decides all texels: what a pixel covers differs from slice to slice.
            settings.radius = kWideRadius * animated.radius;
            for (const Skips& skips : {Skips{}, skips_without("all")}) {
                const Drawn one = draw(animated, gpu, state, settings, {}, skips);
                for (const Splits splits : {Splits::uniform, Splits::logarithmic, Splits::practical}) {
                    const Drawn four = draw(animated, gpu, state, settings, {4, splits}, skips);
                    for (const ShadowMapShape::Limit limit : four.limits) {
                        ASSERT_EQ(limit, ShadowMapShape::Limit::law) << name;
                    }
                    for (const glm::dvec2& texel : four.texels) EXPECT_EQ(texel, one.texels.front()) << name;
                    EXPECT_LE(worst_difference(one.visibility, four.visibility), kOneTexel + kRounding)
                        << name << " at " << t;
                    EXPECT_LE(differing(one.visibility, four.visibility), kMostByATexel) << name << " at " << t;
                }
            }
        }
    }
}

// What a fixed size is spent on is the nearest slice's as much as all others', and the floor beyond all shadows is no slice's.
TEST_F(CascadesOf, MakeAFixedSizeFinerNearTheCamera) {
    const AnimatedScene animated = scene_named("colonnade");
    const GpuScene gpu = upload(animated.scene);
    for (const double t : {0.0, 0.5}) {
        const SceneState state = animated.state(Motion::camera, t);
        ShadowSettings settings;
        settings.fixed_size = 2048;
        const Drawn truth = draw(animated, gpu, state, settings, {});
        settings.fixed_size = 256;
        const Drawn one = draw(animated, gpu, state, settings, {});
        const Drawn many = draw(animated, gpu, state, settings, {4, Splits::logarithmic});
        const std::vector<double> distances = view_distances(state.camera);
        std::vector<double> sorted = distances;
        std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
        const double near_half = sorted[sorted.size() / 2];
        double error_one = 0;
        double error_many = 0;
        for (size_t i = 0; i < distances.size(); ++i) {
            if (distances[i] > near_half) continue;
            error_one += std::abs(one.visibility[i] - truth.visibility[i]);
            error_many += std::abs(many.visibility[i] - truth.visibility[i]);
        }
        EXPECT_GT(error_one, 50) << "what is to be made better";
        EXPECT_LT(error_many, 0.85 * error_one) << "at " << t;
    }
}

}  // namespace
}  // namespace stairstep
