// Shadows of a spot: in the light plane, whose coordinates are tangents, they are a directional light's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/gl/context.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kLevel = 1 / 255.0;
/// Of a box's share.
constexpr double kRounding = 1e-4;
constexpr double kLightHeight = 4;
constexpr double kCasterHeight = 2;
/// Half-sides of the caster.
constexpr double kCasterX = 0.413;
constexpr double kCasterZ = 0.287;

class SpotShadow : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

Light spot_above(double cone_deg = 40, double half_side = 0) {
    return {Light::Kind::spot, basis_towards({0, 90}), {0, kLightHeight, 0}, half_side, 1, cone_deg};
}

Mesh caster_at(double height) {
    const auto x = static_cast<float>(kCasterX);
    const auto y = static_cast<float>(height);
    const auto z = static_cast<float>(kCasterZ);
    return made::polygon({{-x, y, -z}, {-x, y, z}, {x, y, z}, {x, y, -z}}, true);
}

/// A map of tangents made by hand, so that its texel grid is known.
ShadowMapShape shape_over(const Light& light, double texel, int width, int height) {
    const glm::dvec2 half = glm::dvec2(width, height) * texel / 2.0;
    LightFrustum frustum;
    frustum.kind = Light::Kind::spot;
    frustum.basis = light.basis;
    frustum.position = light.position;
    frustum.low = -half;
    frustum.high = half;
    frustum.nearest = 1.9;
    frustum.farthest = 2.1;
    frustum.softness = light.half_side * 0.2 / (1.9 * 2.1);
    return {frustum, width, height, ShadowMapShape::Limit::fixed};
}

/// Whether the caster covers a point of the light plane, tangents.
bool is_covered(const glm::dvec2& tangents) {
    const glm::dvec2 place = tangents * (kLightHeight - kCasterHeight);
    return std::abs(place.x) <= kCasterX && std::abs(place.y) <= kCasterZ;
}

const Camera kCamera = made::camera_down({0.07, 1.9, -0.03});

glm::dvec3 point_at(int column, int row) {
    return made::point_below(kCamera, column, row, kWidth, kHeight, 0);
}

/// Tangents of a point on the ground.
glm::dvec2 tangents(const glm::dvec3& ground) {
    return glm::dvec2(ground.x, -ground.z) / kLightHeight;
}

std::vector<float> draw(const Scene& scene, const Light& light, const std::string& technique, double world_radius,
                        const ShadowMapShape& shape, const Camera& camera = kCamera) {
    ShadowSettings settings;
    settings.technique.filter = FilterMode::exact;
    settings.radius = world_radius;
    return made::draw_visibility(scene, {camera, light, {}}, technique, settings, shape, kWidth, kHeight);
}

TEST_F(SpotShadow, ExactPcfIsTheBoxOverTheTexelsInTangents) {
    const Scene scene = made::scene_of({caster_at(kCasterHeight), made::ground(0, 9)});
    const Light light = spot_above();
    for (const auto& [texel, width, height] : {std::tuple{0.0123, 51, 40}, {0.031, 20, 33}}) {
        for (const double radius : {0.011, 0.043}) {
            const ShadowMapShape shape = shape_over(light, texel, width, height);
            // The radius is a length at the depth of the scene's middle, the caster's.
            const std::vector<float> drawn = draw(scene, light, "pcf", radius * (kLightHeight - kCasterHeight), shape);
            double worst = 0;
            int darker = 0;
            int between = 0;
            for (int row = 0; row < kHeight; ++row) {
                for (int column = 0; column < kWidth; ++column) {
                    const double expected =
                        made::box_over_texels(shape, radius, tangents(point_at(column, row)), is_covered);
                    worst = std::max(worst, std::abs(expected - drawn[static_cast<size_t>(row) * kWidth + column]));
                    darker += expected < 0.1;
                    between += expected > 0.1 && expected < 0.9;
                }
            }
            EXPECT_LE(worst, kLevel);
            EXPECT_GT(darker, 500);
            EXPECT_GT(between, 500);
        }
    }
}

TEST_F(SpotShadow, OutsideTheConeItIsDark) {
    const double cone_deg = 17;
    const Light light = spot_above(cone_deg, 0.1);
    // A caster that shades nothing in the picture.
    const Scene scene = made::scene_of({caster_at(-1), made::ground(0, 9)});
    const double rim = kLightHeight * std::tan(cone_deg * std::numbers::pi / 180);
    for (const std::string technique : {"none", "hard", "pcf", "pcss"}) {
        const std::vector<float> drawn =
            draw(scene, light, technique, 0.05, shape_over(light, 0.02, 60, 60), made::camera_down({0, 3, 0}));
        int inside = 0;
        for (int row = 0; row < kHeight; ++row) {
            for (int column = 0; column < kWidth; ++column) {
                const glm::dvec3 point =
                    made::point_below(made::camera_down({0, 3, 0}), column, row, kWidth, kHeight, 0);
                const double off = glm::length(point) - rim;
                if (std::abs(off) < 1e-4) continue;
                inside += off < 0;
                ASSERT_NEAR(drawn[static_cast<size_t>(row) * kWidth + column], off < 0 ? 1 : 0, kRounding)
                    << technique << " " << off;
            }
        }
        EXPECT_GT(inside, 5000);
        EXPECT_LT(inside, kWidth * kHeight - 5000);
    }
}

// The camera looks down from above the light on a shelf that lies higher than it.
TEST_F(SpotShadow, BehindTheLightItIsDark) {
    const Light light = spot_above(80, 0.1);
    const Mesh shelf = made::polygon({{0, 4.5f, -9}, {0, 4.5f, 9}, {9, 4.5f, 9}, {9, 4.5f, -9}}, false);
    // One that ends in the light's own plane, where tangents have no bounds.
    const Mesh slope = made::polygon({{-9, 4.0f, -9}, {-9, 4.0f, 9}, {-2, 2, 9}, {-2, 2, -9}}, false);
    const Scene scene = made::scene_of({caster_at(2), shelf, slope, made::ground(0, 9)});
    const Camera camera = made::camera_down({0, 9, 0});
    for (const std::string technique : {"none", "hard", "pcf", "pcss"}) {
        for (const ShadowMapShape& shape :
             {shape_over(light, 0.02, 60, 60), map_of_size(made::fitted(scene, light), 128)}) {
            const std::vector<float> drawn = draw(scene, light, technique, 0.05, shape, camera);
            for (int row = 0; row < kHeight; ++row) {
                for (int column = 0; column < kWidth; ++column) {
                    const float value = drawn[static_cast<size_t>(row) * kWidth + column];
                    ASSERT_TRUE(value >= 0 && value <= 1) << technique;
                    if (column > kWidth / 2) {
                        ASSERT_EQ(value, 0) << technique;
                    }
                }
            }
        }
    }
}

// What is nearer to the light than the map's nearest depth, too, shades.
TEST_F(SpotShadow, CastersNearerThanTheNearestDepthCast) {
    const Light light = spot_above();
    for (const double away : {1.0, 0.1, 0.003}) {
        // Some 0.2 in tangents each way, whatever its distance.
        Mesh near = caster_at(kLightHeight - away);
        for (Vertex& vertex : near.vertices) {
            vertex.position.x *= static_cast<float>(away / 2);
            vertex.position.z *= static_cast<float>(away / 2);
        }
        Mesh low = caster_at(0.001);
        for (Vertex& vertex : low.vertices) vertex.position.x += 8;
        const Scene scene = made::scene_of({near, low, made::ground(0, 9)});
        for (const ShadowMapShape& shape :
             {shape_over(light, 0.004, 200, 200), map_of_size(made::fitted(scene, light), 700)}) {
            for (const std::string technique : {"hard", "pcf"}) {
                const std::vector<float> drawn = draw(scene, light, technique, 1e-4, shape);
                int wrong = 0;
                int dark = 0;
                for (int row = 0; row < kHeight; ++row) {
                    for (int column = 0; column < kWidth; ++column) {
                        const glm::dvec2 at = glm::abs(tangents(point_at(column, row)));
                        const double from_rim = std::max(at.x - kCasterX / 2, at.y - kCasterZ / 2);
                        if (std::abs(from_rim) < 2 * std::max(shape.texel().x, shape.texel().y)) continue;
                        const float value = drawn[static_cast<size_t>(row) * kWidth + column];
                        wrong += std::abs(value - (from_rim < 0 ? 0 : 1)) > kRounding;
                        dark += value < kRounding;
                    }
                }
                EXPECT_EQ(wrong, 0) << technique << " " << away;
                EXPECT_GT(dark, 2000);
            }
        }
    }
}

}  // namespace
}  // namespace stairstep
