// Shadows against what geometry says they must be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/gl/context.h"
#include "stimuli/error.h"
#include "stimuli/visibility.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kLevel = 1 / 255.0;

class Shadow : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

/// A light straight above: light x is world x, light y is world −z. Casters at y = 2, the ground at y = 0,
/// beyond the far end of the map; the camera looks down from between.
const Direction kStraightDown{0, 90};
const Camera kCamera = made::camera_down({0, 1.5, 0});

/// A map over [−extent/2, extent/2] along each axis, made by hand so that its texel grid is known.
ShadowMapShape shape_over(double texel, int width, int height) {
    const glm::dvec2 half = glm::dvec2(width, height) * texel / 2.0;
    LightFrustum frustum;
    frustum.basis = basis_towards(kStraightDown);
    frustum.low = -half;
    frustum.high = half;
    frustum.nearest = -2.1;
    frustum.farthest = -1.9;
    return {frustum, width, height, ShadowMapShape::Limit::fixed};
}

template <typename Expected>
void expect_everywhere(const std::vector<float>& drawn, double tolerance, Expected expected) {
    double worst = 0;
    int darker = 0;
    int lighter = 0;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const glm::dvec3 point = made::point_below(kCamera, column, row, kWidth, kHeight, 0);
            const double value = expected(glm::dvec2(point.x, -point.z));
            worst = std::max(worst, std::abs(value - drawn[row * kWidth + column]));
            darker += value < 0.1;
            lighter += value > 0.9;
        }
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_GT(darker, 500) << "the picture should show the shadow";
    EXPECT_GT(lighter, 500) << "the picture should show the light";
}

// The stimuli's stair is a silhouette at 45° whose line goes through the middle of treads: texel centres lie
// at whole texels along x (an odd count, centred) and at halves along y (an even one).
TEST_F(Shadow, ExactPcfIsTheStimulisStair) {
    const Scene scene = made::scene_of({made::polygon({{-9, 2, 9}, {9, 2, -9}, {9, 2, 9}}, true), made::ground(0, 9)});
    for (const double texel : {0.05, 0.11}) {
        for (const double radius_texels : {0.3, 1.0, 3.47, 3.5, 6.2}) {
            const double radius = radius_texels * texel;
            const std::vector<float> drawn = made::draw_visibility(
                scene, kCamera, "pcf", {radius, FilterMode::exact, 0}, shape_over(texel, 101, 100), kWidth, kHeight);
            SCOPED_TRACE(testing::Message() << "texel " << texel << ", radius " << radius_texels << " texels");
            // A filter below a texel blurs steps over so few pixels that their rounding in float shows more.
            const double tolerance = radius_texels < 1 ? 4 * kLevel : kLevel;
            expect_everywhere(drawn, tolerance, [&](const glm::dvec2& p) {
                return visibility(Edge::stair(texel), {KernelShape::box, radius}, {p.x, p.y});
            });
        }
    }
}

TEST_F(Shadow, ExactPcfIsTheBoxOverTheTexelsOfAnyCaster) {
    struct Case {
        const char* name;
        std::vector<glm::vec3> corners;
        bool (*covers)(const glm::dvec2&);
    };
    const std::vector<Case> cases{
        {"rectangle",
         {{-0.413f, 2, -0.287f}, {-0.413f, 2, 0.287f}, {0.413f, 2, 0.287f}, {0.413f, 2, -0.287f}},
         [](const glm::dvec2& p) { return std::abs(p.x) <= 0.413 && std::abs(p.y) <= 0.287; }},
        {"diamond", {{-0.513f, 2, 0}, {0, 2, 0.513f}, {0.513f, 2, 0}, {0, 2, -0.513f}}, [](const glm::dvec2& p) {
             return std::abs(p.x) + std::abs(p.y) <= 0.513;
         }}};
    for (const Case& shape_case : cases) {
        SCOPED_TRACE(shape_case.name);
        const Scene scene = made::scene_of({made::polygon(shape_case.corners, true), made::ground(0, 9)});
        // Texels of two proportions: the map covers the same rectangle with 49 × 40 and 49 × 23.
        for (const int height : {40, 23}) {
            ShadowMapShape shape = shape_over(0.041, 49, 40);
            shape.height = height;
            const double radius = 0.14;
            const std::vector<float> drawn =
                made::draw_visibility(scene, kCamera, "pcf", {radius, FilterMode::exact, 0}, shape, kWidth, kHeight);
            expect_everywhere(drawn, kLevel, [&](const glm::dvec2& p) {
                return made::box_over_texels(shape, radius, p, shape_case.covers);
            });
        }
    }
}

TEST_F(Shadow, SampledPcfIsWithoutBias) {
    const Scene scene = made::scene_of({made::polygon({{-9, 2, 9}, {9, 2, -9}, {9, 2, 9}}, true), made::ground(0, 9)});
    const ShadowMapShape shape = shape_over(0.021, 201, 200);
    const double radius = 0.3;
    const auto draw = [&](FilterMode mode) {
        return made::draw_visibility(scene, kCamera, "pcf", {radius, mode, 16}, shape, kWidth, kHeight);
    };
    const std::vector<float> exact = draw(FilterMode::exact);
    const std::vector<float> sampled = draw(FilterMode::jittered);
    const made::SamplingError error = made::sampling_error(sampled, exact);
    ASSERT_GT(error.pixels, 10000);
    EXPECT_GT(error.deviation, 0.005) << "the two modes can't agree to the last bit";
    EXPECT_LT(error.deviation, 0.08) << "16 stratified taps are better than this";
    EXPECT_LT(std::abs(error.mean), 4 * error.deviation / std::sqrt(error.pixels));
}

TEST_F(Shadow, HardIsOneTexel) {
    const Scene scene = made::scene_of({made::polygon({{-9, 2, 9}, {9, 2, -9}, {9, 2, 9}}, true), made::ground(0, 9)});
    const std::vector<float> drawn = made::draw_visibility(scene, kCamera, "hard", {1, FilterMode::automatic, 0},
                                                           shape_over(0.11, 101, 100), kWidth, kHeight);
    int wrong = 0;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const glm::dvec3 p = made::point_below(kCamera, column, row, kWidth, kHeight, 0);
            wrong += drawn[row * kWidth + column] !=
                     static_cast<float>(visibility(Edge::stair(0.11), {KernelShape::box, 0}, {p.x, -p.z}));
        }
    }
    EXPECT_EQ(wrong, 0);
}

TEST_F(Shadow, ABoxFarBelowATexelIsHard) {
    const Scene scene = made::scene_of({made::polygon({{-9, 2, 9}, {9, 2, -9}, {9, 2, 9}}, true), made::ground(0, 9)});
    const ShadowMapShape shape = shape_over(0.11, 101, 100);
    const auto draw = [&](const std::string& technique) {
        return made::draw_visibility(scene, kCamera, technique, {1e-9, FilterMode::automatic, 0}, shape, kWidth,
                                     kHeight);
    };
    const std::vector<float> hard = draw("hard");
    const std::vector<float> pcf = draw("pcf");
    int differing = 0;
    for (size_t i = 0; i < hard.size(); ++i) differing += std::abs(hard[i] - pcf[i]) > kLevel;
    EXPECT_LT(differing, 20) << "only pixels right on a step may";
}

TEST_F(Shadow, NoneIsLit) {
    const Scene scene = made::scene_of({made::polygon({{-9, 2, 9}, {9, 2, -9}, {9, 2, 9}}, true), made::ground(0, 9)});
    for (const float value : made::draw_visibility(scene, kCamera, "none", {1, FilterMode::automatic, 0},
                                                   shape_over(0.11, 101, 100), kWidth, kHeight)) {
        ASSERT_EQ(value, 1);
    }
}

TEST_F(Shadow, ASphereHasNoAcne) {
    const Scene scene = made::scene_of({made::sphere(1, 48)});
    const Direction light{40, 35};
    const LightFrustum frustum = made::fitted(scene, light);
    // From where the light comes from, every facet that can be seen faces it, and a convex body never shades
    // itself.
    const Camera camera = made::camera_at(4.0 * basis_towards(light).back, light);
    for (const int side : {32, 300, 2048}) {
        for (const std::string technique : {"hard", "pcf"}) {
            const std::vector<float> drawn =
                made::draw_visibility(scene, camera, technique, {0.1, FilterMode::automatic, 25},
                                      map_of_size(frustum, side), kWidth, kHeight);
            const auto dark = std::count_if(drawn.begin(), drawn.end(), [](float v) { return v < 1 - kLevel; });
            EXPECT_EQ(dark, 0) << technique << " " << side;
        }
    }
}

TEST_F(Shadow, ATiltedPlaneHasNoAcne) {
    const Scene scene = made::scene_of({made::polygon({{-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}}, true)});
    for (const double elevation : {5.0, 20.0, 60.0, 90.0}) {
        const LightFrustum frustum = made::fitted(scene, {33, elevation});
        for (const int side : {64, 1024}) {
            const std::vector<float> drawn =
                made::draw_visibility(scene, made::camera_down({0, 3, 0}), "pcf", {0.1, FilterMode::automatic, 25},
                                      map_of_size(frustum, side), kWidth, kHeight);
            const auto dark = std::count_if(drawn.begin(), drawn.end(), [](float v) { return v < 1 - kLevel; });
            EXPECT_EQ(dark, 0) << "elevation " << elevation << ", side " << side;
        }
    }
}

TEST_F(Shadow, ReachesUpToTheFootOfABox) {
    std::vector<Mesh> meshes = made::box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f});
    meshes.push_back(made::ground(0, 9));
    const Scene scene = made::scene_of(meshes);
    // From +x at 45°: the shadow covers the ground from x = −0.5 to −1.5.
    const ShadowMapShape shape = map_of_size(made::fitted(scene, {90, 45}), 128);
    const Camera camera = made::camera_down({-1, 4, 0});
    const double texel = std::max(shape.texel().x, shape.texel().y) * std::sqrt(2.0);
    for (const std::string technique : {"hard", "pcf"}) {
        const std::vector<float> drawn =
            made::draw_visibility(scene, camera, technique, {0.02, FilterMode::automatic, 25}, shape, kWidth, kHeight);
        const int row = kHeight / 2;
        int checked = 0;
        for (int column = 0; column < kWidth; ++column) {
            const double x = made::point_below(camera, column, row, kWidth, kHeight, 0).x;
            const float value = drawn[row * kWidth + column];
            if (x < -0.5 - 1e-6 && x > -1.5 + 0.02 * std::sqrt(2.0) + 2 * texel) {
                EXPECT_NEAR(value, 0, 1e-5) << technique << " at x " << x;
                ++checked;
            }
            if (x < -1.5 - 0.02 * std::sqrt(2.0) - 2 * texel) {
                EXPECT_NEAR(value, 1, 1e-5) << technique << " at x " << x;
            }
        }
        EXPECT_GT(checked, 40);
    }
}

TEST_F(Shadow, ColourFramesDrawWithAndWithoutSamples) {
    std::vector<Mesh> meshes = made::box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f});
    meshes.push_back(made::ground(0, 9));
    const Scene scene = made::scene_of(meshes);
    const GpuScene gpu = upload(scene);
    SceneState state;
    state.camera = made::camera_down({-1, 4, 0});
    state.light = directional_light({90, 45}, 0);
    ShadowSettings settings = made::settings_of({0.05, FilterMode::automatic, 25});
    settings.fixed_size = 128;
    ShadowRenderer renderer(technique_named("pcf"), settings, gpu, state, 64.0 / 48);
    for (const int samples : {1, 4}) {
        const FrameTarget target = make_frame_target(Show::colour, 64, 48, samples);
        gl::PassTimer timer;
        // Throws on any GL error.
        renderer.draw(gpu, state, target, timer);
        const Image picture = read_colour(target);
        const uint8_t* shadow = picture.at(32, 24);
        const uint8_t* light = picture.at(2, 24);
        EXPECT_GT(light[0], shadow[0] + 30) << samples;
        EXPECT_GT(shadow[2], 20) << "a shadow still sees the sky";
    }
}

/// A map that nothing is drawn into.
ShadowMap map_of(const ShadowMapShape& shape, double filter_radius) {
    return {std::max(shape.width, shape.height), {}, shape, filter_radius};
}

std::unique_ptr<ShadowTechnique> made_pcf(const made::Filter& filter, const ShadowMap& map) {
    return technique_named("pcf").make(made::settings_of(filter).technique, map, false);
}

TEST_F(Shadow, SettingsOutOfRangeAreInputErrors) {
    const auto make = [&](const made::Filter& filter) {
        made_pcf(filter, map_of(shape_over(0.01, 101, 100), filter.radius));
    };
    for (const FilterMode mode : {FilterMode::regular, FilterMode::jittered}) {
        EXPECT_THROW(make({0.3, mode, 24}), InputError);
    }
    for (const FilterMode mode :
         {FilterMode::regular, FilterMode::jittered, FilterMode::poisson, FilterMode::rotated}) {
        EXPECT_THROW(make({0.3, mode, 0}), InputError);
        EXPECT_THROW(make({0.3, mode, -25}), InputError);
        EXPECT_THROW(make({0.3, mode, 65 * 65}), InputError);
    }
    EXPECT_THROW(make({3, FilterMode::exact, 25}), InputError);
    EXPECT_THROW(technique_named("ray"), InputError);
    EXPECT_THROW(filter_mode_named("round"), InputError);
}

// The law's box takes 8 × 8 texels: 16 gathers.
TEST_F(Shadow, GathersCoverTheBoxAndNoMore) {
    const auto gathers = [&](double radius_texels) {
        const ShadowMap map = map_of(shape_over(0.01, 100, 100), radius_texels * 0.01);
        return made_pcf({map.filter_radius, FilterMode::exact, 0}, map)->lookups(map).filter;
    };
    EXPECT_EQ(gathers(0.5), 1);
    EXPECT_EQ(gathers(0.6), 4);
    EXPECT_EQ(gathers(3.47), 16);
    EXPECT_EQ(gathers(3.5), 16);
    EXPECT_EQ(gathers(3.6), 25);
    EXPECT_EQ(gathers(4.5), 25);
}

}  // namespace
}  // namespace stairstep
