// Variance and exponential shadow maps against closed forms, and against the exact filter that they approximate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/gl/context.h"
#include "renderer/prefiltered_map.h"
#include "stimuli/error.h"
#include "stimuli/random.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
/// Of a filter's share, and of moments in float.
constexpr double kRounding = 2e-4;
/// k times the filter's half-width (techniques/esm.cpp).
constexpr double kExponentTimesRadius = 1;

class Prefiltered : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

/// Straight down: light x is world x, light y is world −z. The map's depths end above the ground at y = 0.
ShadowMapShape shape_over(double texel, int width, int height) {
    const glm::dvec2 half = glm::dvec2(width, height) * texel / 2.0;
    LightFrustum frustum;
    frustum.basis = basis_towards({0, 90});
    frustum.low = -half;
    frustum.high = half;
    frustum.nearest = -8.1;
    frustum.farthest = -1.55;
    return {frustum, width, height, ShadowMapShape::Limit::fixed};
}

/// A rectangle at a height, across a light from straight above.
Mesh plate(double y, const glm::dvec2& low, const glm::dvec2& high) {
    const auto at = [&](double x, double z) { return glm::vec3(x, y, z); };
    return made::polygon({at(low.x, low.y), at(low.x, high.y), at(high.x, high.y), at(high.x, low.y)}, true);
}

const Camera kCamera = made::camera_down({0, 1.5, 0});

std::vector<float> draw(const Scene& scene, const std::string& technique, double radius, const ShadowMapShape& shape,
                        double bleeding_reduction = 0, const Camera& camera = kCamera) {
    SceneState state;
    state.camera = camera;
    state.light.basis = shape.frustum.basis;
    ShadowSettings settings = made::settings_of({radius, FilterMode::exact, 0});
    settings.technique.bleeding_reduction = bleeding_reduction;
    return made::draw_visibility(scene, state, technique, settings, shape, kWidth, kHeight);
}

glm::dvec2 light_point(int column, int row, const Camera& camera = kCamera) {
    const glm::dvec3 point = made::point_below(camera, column, row, kWidth, kHeight, 0);
    return {point.x, -point.z};
}

/// `expected` at pixels all over the ground; some of it is in shadow and some not.
template <typename Expected>
void expect_everywhere(const std::vector<float>& drawn, double tolerance, Expected expected) {
    double worst = 0;
    double darkest = 1;
    double lightest = 0;
    // Steps that share no factor with the texels' own.
    for (int row = 0; row < kHeight; row += 5) {
        for (int column = 0; column < kWidth; column += 7) {
            const double value = expected(light_point(column, row));
            worst = std::max(worst, std::abs(value - drawn[static_cast<size_t>(row) * kWidth + column]));
            darkest = std::min(darkest, value);
            lightest = std::max(lightest, value);
        }
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_GT(lightest - darkest, 0.05) << "the picture should show an edge";
}

TEST(PrefilterAxis, AnchorValues) {
    const PrefilterAxis law = prefilter_axis(3.47);
    EXPECT_EQ(law.factor, 1);
    EXPECT_EQ(law.reach, 3);
    EXPECT_NEAR(law.end_weight, 0.97, 1e-12);
    const PrefilterAxis wide = prefilter_axis(100);
    EXPECT_EQ(wide.factor, 8);
    EXPECT_EQ(wide.radius, 12.5);
    EXPECT_EQ(wide.reach, 12);
    EXPECT_EQ(wide.end_weight, 1);
    EXPECT_EQ(prefilter_axis(0).reach, 0);
    EXPECT_EQ(prefilter_axis(0.5).reach, 0);
}

TEST(PrefilterAxis, BlocksAddUpToTheBox) {
    for (double radius = 0.51; radius < 1e12; radius *= 1.037) {
        const PrefilterAxis axis = prefilter_axis(radius);
        EXPECT_NEAR(axis.radius * axis.factor, radius, 1e-12 * radius);
        EXPECT_LT(axis.radius, kWidestPrefilter);
        EXPECT_GE(axis.radius, axis.factor > 1 ? kWidestPrefilter / 2 : 0.5);
        EXPECT_GT(axis.end_weight, 0);
        EXPECT_LE(axis.end_weight, 1);
        EXPECT_NEAR((2 * axis.reach - 1 + 2 * axis.end_weight) / (2 * axis.radius), 1, 1e-5);
    }
}

// Casters of one depth over a receiver far below leave no doubt: the variance is 0, and the exponential too.
TEST_F(Prefiltered, OneCasterIsTheExactBoxWhereItIsOddTexelsWide) {
    const Scene scene = made::scene_of({plate(2, {-0.413, -0.287}, {0.413, 0.287}), made::ground(0, 9)});
    const auto covers = [](const glm::dvec2& p) { return std::abs(p.x) <= 0.413 && std::abs(p.y) <= 0.287; };
    for (const double radius_texels : {0.5, 1.5, 3.5, 7.5}) {
        const ShadowMapShape shape = shape_over(0.031, 64, 51);
        const double radius = radius_texels * 0.031;
        const auto box = [&](const glm::dvec2& p) { return made::box_over_texels(shape, radius, p, covers); };
        for (const std::string technique : {"vsm", "esm"}) {
            SCOPED_TRACE(testing::Message() << technique << " " << radius_texels);
            expect_everywhere(draw(scene, technique, radius, shape), kRounding, box);
        }
        expect_everywhere(draw(scene, "vsm", radius, shape, 0.3), kRounding, box);
    }
}

// A corner where the box's slope changes by 1/(2r) lies amid two texels' centres at worst, along both axes.
TEST_F(Prefiltered, AnyOtherBoxIsOffByNoMoreThanItsInterpolation) {
    const Scene scene = made::scene_of({plate(2, {-0.413, -0.287}, {0.413, 0.287}), made::ground(0, 9)});
    const auto covers = [](const glm::dvec2& p) { return std::abs(p.x) <= 0.413 && std::abs(p.y) <= 0.287; };
    const auto check = [&](double texel, double radius_texels, double bound) {
        const int side = static_cast<int>(2.1 / texel);
        const ShadowMapShape shape = shape_over(texel, side, side);
        for (const std::string technique : {"vsm", "esm"}) {
            SCOPED_TRACE(testing::Message() << technique << " " << radius_texels);
            expect_everywhere(
                draw(scene, technique, radius_texels * texel, shape), bound + kRounding,
                [&](const glm::dvec2& p) { return made::box_over_texels(shape, radius_texels * texel, p, covers); });
        }
    };
    for (const double radius_texels : {1.0, 3.47, 6.2}) check(0.031, radius_texels, 2 / (8 * radius_texels));
    // Blocks of 2 and of 4 texels, of which a box of 9 and of 10 half-widths is made.
    check(0.021, 18, 2 / (8 * 9.0));
    check(0.011, 40, 2 / (8 * 10.0));
}

TEST_F(Prefiltered, WithoutARadiusTexelsAreInterpolated) {
    const Scene scene = made::scene_of({plate(2, {-0.413, -0.287}, {0.413, 0.287}), made::ground(0, 9)});
    const ShadowMapShape shape = shape_over(0.11, 21, 20);
    const auto lit = [&](double i, double j) {
        const glm::dvec2 p = shape.frustum.low + (glm::dvec2(i, j) + 0.5) * 0.11;
        return std::abs(p.x) <= 0.413 && std::abs(p.y) <= 0.287 ? 0.0 : 1.0;
    };
    for (const std::string technique : {"vsm", "esm"}) {
        expect_everywhere(draw(scene, technique, 1e-9, shape), kRounding, [&](const glm::dvec2& p) {
            const glm::dvec2 place = (p - shape.frustum.low) / 0.11 - 0.5;
            const glm::dvec2 first = glm::floor(place);
            const glm::dvec2 part = place - first;
            const auto row = [&](double j) { return glm::mix(lit(first.x, j), lit(first.x + 1, j), part.x); };
            return glm::mix(row(first.y), row(first.y + 1), part.y);
        });
    }
}

/// Two casters over the whole picture, the upper one to the right of x = 0.1 alone: the ground is dark.
constexpr double kUpper = 8;
constexpr double kLower = 1.6;
constexpr double kWideTexel = 0.5;
constexpr double kWideRadius = 4.5 * kWideTexel;

Scene two_casters() {
    return made::scene_of(
        {plate(kUpper, {0.1, -40}, {40, 40}), plate(kLower, {-40, -40}, {40, 40}), made::ground(0, 9)});
}

double upper_share(const ShadowMapShape& shape, const glm::dvec2& p) {
    return 1 - made::box_over_texels(shape, kWideRadius, p, [](const glm::dvec2& q) { return q.x >= 0.1; });
}

TEST_F(Prefiltered, VarianceBleedsAsMuchAsChebyshevAllows) {
    const ShadowMapShape shape = shape_over(kWideTexel, 60, 60);
    for (const double reduction : {0.0, 0.02, 0.2}) {
        expect_everywhere(draw(two_casters(), "vsm", kWideRadius, shape, reduction), kRounding,
                          [&](const glm::dvec2& p) {
                              const double upper = upper_share(shape, p);
                              const double mean = upper * kUpper + (1 - upper) * kLower;
                              const double variance = upper * (1 - upper) * (kUpper - kLower) * (kUpper - kLower);
                              const double bound = variance / (variance + mean * mean);
                              return std::max(0.0, (bound - reduction) / (1 - reduction));
                          });
    }
}

TEST_F(Prefiltered, ExponentialBleedsByTheCastersHeights) {
    const ShadowMapShape shape = shape_over(kWideTexel, 60, 60);
    const double k = kExponentTimesRadius / kWideRadius;
    const std::vector<float> drawn = draw(two_casters(), "esm", kWideRadius, shape);
    expect_everywhere(drawn, kRounding, [&](const glm::dvec2& p) {
        const double upper = upper_share(shape, p);
        return upper * std::exp(-k * kUpper) + (1 - upper) * std::exp(-k * kLower);
    });
}

/// Plates at random places and a few heights, seen from above: receivers lie at each of them and below.
Scene random_plates(Random& random) {
    std::vector<Mesh> meshes{made::ground(0, 9)};
    for (int i = 0; i < 14; ++i) {
        const glm::dvec2 middle(3 * random.uniform() - 1.5, 3 * random.uniform() - 1.5);
        const glm::dvec2 half(0.1 + 0.5 * random.uniform(), 0.1 + 0.5 * random.uniform());
        meshes.push_back(plate(1.6 + 0.2 * static_cast<double>(random.below(3)), middle - half, middle + half));
    }
    return made::scene_of(meshes);
}

// Chebyshev's inequality is one: no window of depths lets vsm be darker than the share of them that is lit.
TEST_F(Prefiltered, VarianceIsAnUpperBoundOfTheExactBox) {
    Random random(7);
    const Camera camera = made::camera_down({0, 4, 0});
    int lighter = 0;
    for (int trial = 0; trial < 8; ++trial) {
        const Scene scene = random_plates(random);
        const double texel = 0.05 + 0.05 * random.uniform();
        const double radius = texel * (0.5 + static_cast<double>(random.below(7)));
        const int side = static_cast<int>(3.6 / texel);
        const ShadowMapShape shape = shape_over(texel, side, side);
        const std::vector<float> exact = draw(scene, "pcf", radius, shape, 0, camera);
        const std::vector<float> bound = draw(scene, "vsm", radius, shape, 0, camera);
        int darker = 0;
        for (size_t i = 0; i < exact.size(); ++i) {
            darker += bound[i] < exact[i] - kRounding;
            lighter += bound[i] > exact[i] + 0.1;
        }
        EXPECT_EQ(darker, 0) << "trial " << trial;
    }
    EXPECT_GT(lighter, 1000) << "and it isn't the share itself";
}

TEST_F(Prefiltered, NoAcneOnASphereOrATiltedPlane) {
    const auto expect_lit = [](const Scene& scene, const ShadowMapShape& shape, const Camera& camera) {
        for (const std::string technique : {"vsm", "esm"}) {
            for (const double radius : {1e-9, 0.02, 0.1}) {
                const std::vector<float> drawn = draw(scene, technique, radius, shape, 0.2, camera);
                EXPECT_GE(*std::min_element(drawn.begin(), drawn.end()), 1 - 1 / 255.0)
                    << technique << " radius " << radius << ", " << shape.width << " texels";
            }
        }
    };
    const Direction light{40, 35};
    const Scene sphere = made::scene_of({made::sphere(1, 48)});
    const Scene plane = made::scene_of({plate(0, {-3, -3}, {3, 3})});
    // One whose rims are seen: within the filter there is nothing below them that would make up for what is above.
    const Scene small = made::scene_of({plate(0, {-0.7, -0.6}, {0.7, 0.6})});
    for (const int side : {32, 300}) {
        expect_lit(sphere, map_of_size(made::fitted(sphere, light), side),
                   made::camera_at(4.0 * basis_towards(light).back, light));
        for (const double elevation : {5.0, 20.0, 60.0, 90.0}) {
            for (const Scene& scene : {plane, small}) {
                expect_lit(scene, map_of_size(made::fitted(scene, {33, elevation}), side),
                           made::camera_down({0, 3, 0}));
            }
        }
    }
}

// Pixels far larger than texels are filtered by mipmaps: a fine grid's shadow is grey, and evenly so.
TEST_F(Prefiltered, MipmapsAverageWhatAPixelCovers) {
    std::vector<Mesh> meshes{made::ground(0, 400)};
    for (int i = -200; i < 200; ++i) meshes.push_back(plate(2, {0.1 * i, -20}, {0.1 * i + 0.05, 20}));
    const Scene scene = made::scene_of(meshes);
    const ShadowMapShape shape = shape_over(0.025, 1536, 1536);
    // From below the plates the picture is 1.7 high; looked at from far above, with the plates seen from behind, 100.
    Camera far = made::camera_down({0, 90, 0});
    far.far = 200;
    for (const std::string technique : {"vsm", "esm"}) {
        const std::vector<float> drawn = draw(scene, technique, 1e-9, shape, 0, far);
        // A plate faces the light and is lit; what is seen between them is the ground: half of the light passes.
        int between = 0;
        for (int row = 100; row < 140; ++row) {
            for (int column = 140; column < 180; ++column) {
                const float value = drawn[static_cast<size_t>(row) * kWidth + column];
                if (value > 0.99f) continue;
                EXPECT_NEAR(value, 0.5, 0.05) << technique;
                ++between;
            }
        }
        EXPECT_GT(between, 100);
    }
}

// In tangents a spot's shadow is a directional light's; stored depth is linear in 1/z, and so are heights.
TEST_F(Prefiltered, OfASpotOneCasterIsTheExactBox) {
    const Light light{Light::Kind::spot, basis_towards({0, 90}), {0, 4, 0}, 0, 1, 40};
    LightFrustum frustum;
    frustum.kind = Light::Kind::spot;
    frustum.basis = light.basis;
    frustum.position = light.position;
    frustum.low = glm::dvec2(-0.31);
    frustum.high = glm::dvec2(0.31);
    frustum.nearest = 1.9;
    frustum.farthest = 2.1;
    const ShadowMapShape shape{frustum, 50, 50, ShadowMapShape::Limit::fixed};
    const double radius = 3.5 * shape.texel().x;
    const Scene scene = made::scene_of({plate(2, {-0.413, -0.287}, {0.413, 0.287}), made::ground(0, 9)});
    ShadowSettings settings;
    // A length at the depth of the scene's middle, the caster's.
    settings.radius = 2 * radius;
    const Camera camera = made::camera_down({0.07, 1.9, -0.03});
    for (const std::string technique : {"vsm", "esm"}) {
        const std::vector<float> drawn =
            made::draw_visibility(scene, {camera, light, {}}, technique, settings, shape, kWidth, kHeight);
        for (int row = 0; row < kHeight; ++row) {
            for (int column = 0; column < kWidth; ++column) {
                const glm::dvec2 tangents = light_point(column, row, camera) / 4.0;
                const double box = made::box_over_texels(shape, radius, tangents, [](const glm::dvec2& p) {
                    return std::abs(2 * p.x) <= 0.413 && std::abs(2 * p.y) <= 0.287;
                });
                ASSERT_NEAR(drawn[static_cast<size_t>(row) * kWidth + column], box, 5 * kRounding) << technique;
            }
        }
    }
}

TEST_F(Prefiltered, RefusesABleedingReductionOutOfRange) {
    const ShadowMap map{100, {}, shape_over(0.01, 100, 100), 0.1};
    for (const double reduction : {-0.1, 0.96, 1.0, std::nan(""), static_cast<double>(INFINITY)}) {
        TechniqueSettings settings;
        settings.bleeding_reduction = reduction;
        EXPECT_THROW(technique_named("vsm").make(settings, map, false), InputError) << reduction;
    }
}

}  // namespace
}  // namespace stairstep
