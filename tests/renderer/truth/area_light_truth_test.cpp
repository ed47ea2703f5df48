// The truth against closed forms.
#include "renderer/truth/area_light_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/visibility.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;
const Direction kSlanted{30, 55};

/// Looks straight down on the ground at y = 0 from below the casters.
const Camera kCamera = made::camera_down({0.1, 1, -0.05});

glm::dvec3 point_at(int column, int row) {
    return made::point_below(kCamera, column, row, kWidth, kHeight, 0);
}

std::vector<float> truth(const Scene& scene, const Light& light, int samples, const Camera& camera = kCamera,
                         int jobs = 2) {
    return area_light_visibility(scene, {camera, light, {}}, kWidth, kHeight, samples, jobs);
}

/// Across the light, from its axis or from the world's origin.
glm::dvec2 across(const Light& light, const glm::dvec3& point) {
    const glm::dvec3 from = light.kind == Light::Kind::spot ? point - light.position : point;
    return {glm::dot(light.basis.right, from), glm::dot(light.basis.up, from)};
}

glm::vec3 at_depth(const Light& light, double x, double y, double depth) {
    const glm::dvec3 origin = light.kind == Light::Kind::spot ? light.position : glm::dvec3(0);
    return glm::vec3(origin + x * light.basis.right + y * light.basis.up - depth * light.basis.back);
}

/// What is below y = slope·x across the light, as a caster parallel to the light's square.
Mesh half_plane(const Light& light, double slope, double depth) {
    const double length = std::hypot(1.0, slope);
    const glm::dvec2 along = 2.5 * glm::dvec2(1, slope) / length;
    const glm::dvec2 below = 2.5 * glm::dvec2(slope, -1.0) / length;
    const auto corner = [&](const glm::dvec2& p) { return at_depth(light, p.x, p.y, depth); };
    return made::polygon({corner(-along), corner(along), corner(along + below), corner(below - along)}, true);
}

/// V at a point by the box filter of the half-plane's silhouette.
double box_visibility(const Light& light, double slope, double caster_depth, const glm::dvec3& point) {
    const double depth = depth_along(light, point);
    glm::dvec2 place = across(light, point);
    double radius = light.half_tangent() * (depth - caster_depth);
    if (light.kind == Light::Kind::spot) {
        place /= depth;
        radius = light.half_side * (1 / caster_depth - 1 / depth);
    }
    return visibility(Edge::line(slope), {KernelShape::box, radius}, {place.x, place.y});
}

/// Errors of the truth over the pixels where the closed form has a penumbra.
struct Errors {
    int count = 0;
    double worst = 0;
    double squares = 0;
    double sum = 0;
    double worst_outside = 0;
};

Errors errors_at_half_plane(const Light& light, double slope, double caster_depth, int samples) {
    const Scene scene = made::scene_of({half_plane(light, slope, caster_depth), made::ground(0, 9)});
    const std::vector<float> values = truth(scene, light, samples);
    Errors errors;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const double expected = box_visibility(light, slope, caster_depth, point_at(column, row));
            const double error = values[row * kWidth + column] - expected;
            // Where the closed form itself is at its end to a millionth, floats may leave a sample on the other side.
            if (expected < 1e-6 || expected > 1 - 1e-6) {
                errors.worst_outside = std::max(errors.worst_outside, std::abs(error));
                continue;
            }
            ++errors.count;
            errors.worst = std::max(errors.worst, std::abs(error));
            errors.squares += error * error;
            errors.sum += error;
        }
    }
    return errors;
}

/// `cut` is how many cells of the square an edge can cut: each is one point that is right or wrong.
void expect_sampling_error_alone(const Errors& errors, double cut, int samples) {
    ASSERT_GT(errors.count, 1000) << "the picture should show the penumbra";
    EXPECT_LE(errors.worst, cut / samples + 1e-6);
    const double deviation = std::sqrt(cut) / (2 * samples);
    EXPECT_LE(std::sqrt(errors.squares / errors.count), deviation);
    EXPECT_LE(std::abs(errors.sum / errors.count), 5 * deviation / std::sqrt(errors.count)) << "is biased";
    EXPECT_LE(errors.worst_outside, 1.0 / samples);
}

Light light_of(Light::Kind kind) {
    if (kind == Light::Kind::directional) return directional_light(kSlanted, 0.1);
    return spot_light(5.0 * basis_towards(kSlanted).back, glm::dvec3(0), 0.5, 40);
}

/// Some 2.5 above the ground, well between a spot and what it lights.
double caster_depth_of(Light::Kind kind) {
    return kind == Light::Kind::directional ? -2.5 : 2.5;
}

class StraightEdge : public testing::TestWithParam<Light::Kind> {};

TEST_P(StraightEdge, AlongTheSquareIsARamp) {
    const Light light = light_of(GetParam());
    for (const int side : {8, 32}) {
        const Errors errors = errors_at_half_plane(light, 0, caster_depth_of(GetParam()), side * side);
        expect_sampling_error_alone(errors, side, side * side);
    }
}

TEST_P(StraightEdge, OfAnySlopeIsTheExactBoxFilter) {
    const Light light = light_of(GetParam());
    for (const double slope : {0.13, 0.5, 1.0, 3.0}) {
        SCOPED_TRACE(slope);
        for (const int side : {5, 32}) {
            const Errors errors = errors_at_half_plane(light, slope, caster_depth_of(GetParam()), side * side);
            expect_sampling_error_alone(errors, 2 * side - 1, side * side);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(OfEachLight, StraightEdge, testing::Values(Light::Kind::directional, Light::Kind::spot),
                         [](const auto& info) { return info.param == Light::Kind::spot ? "spot" : "directional"; });

TEST(AreaLightTruth, OnlyTheAngleOfADirectionalLightMatters) {
    Light far = directional_light(kSlanted, 0.1);
    far.half_side *= 1024;
    far.distance *= 1024;
    const Scene scene = made::scene_of({half_plane(far, 0.5, -2.5), made::ground(0, 9)});
    EXPECT_EQ(truth(scene, far, 64), truth(scene, directional_light(kSlanted, 0.1), 64));
}

// A triangle's shadow from a point is its projection: no pixel may differ whose centre isn't right on its rim.
TEST(AreaLightTruth, APointLightCastsTheProjection) {
    for (const Light::Kind kind : {Light::Kind::directional, Light::Kind::spot}) {
        Light light = light_of(kind);
        light.half_side = 0;
        const double depth = caster_depth_of(kind);
        const std::vector<glm::dvec2> corners{{-0.21, -0.13}, {0.27, -0.05}, {0.03, 0.24}};
        std::vector<glm::vec3> corners_in_world;
        for (const glm::dvec2& c : corners) corners_in_world.push_back(at_depth(light, c.x, c.y, depth));
        const Scene scene = made::scene_of({made::polygon(corners_in_world, true), made::ground(0, 9)});
        const std::vector<float> values = truth(scene, light, 1024);
        int dark = 0;
        int wrong = 0;
        for (int row = 0; row < kHeight; ++row) {
            for (int column = 0; column < kWidth; ++column) {
                const glm::dvec3 point = point_at(column, row);
                const double scale = kind == Light::Kind::spot ? depth / depth_along(light, point) : 1;
                const glm::dvec2 place = across(light, point) * scale;
                // Positive inside, as the corners run counterclockwise.
                double inside = INFINITY;
                for (int i = 0; i < 3; ++i) {
                    const glm::dvec2 side = glm::normalize(corners[(i + 1) % 3] - corners[i]);
                    const glm::dvec2 from = place - corners[i];
                    inside = std::min(inside, side.x * from.y - side.y * from.x);
                }
                const float value = values[row * kWidth + column];
                wrong += std::abs(inside) > 1e-5 && value != (inside > 0 ? 0.0f : 1.0f);
                dark += value == 0;
            }
        }
        EXPECT_EQ(wrong, 0);
        EXPECT_GT(dark, 100);
    }
}

TEST(AreaLightTruth, ASpotEndsAtItsConeAndAtItsPlace) {
    // A ceiling above the spot shades nothing. The cone of 20° meets the ground at a distance of 2·tan 20°.
    const Light light = spot_light({0, 2, 0}, {0, 0, 0}, 0.1, 20);
    Mesh ceiling = made::ground(2.5f, 9);
    ceiling.casts = true;
    const Scene scene = made::scene_of({ceiling, made::ground(0, 9)});
    const std::vector<float> values = truth(scene, light, 64);
    const double reach = 2 * std::tan(20 * std::numbers::pi / 180);
    int lit = 0;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const double distance = glm::length(point_at(column, row));
            if (std::abs(distance - reach) < 1e-6) continue;
            ASSERT_EQ(values[row * kWidth + column], distance < reach ? 1 : 0) << distance;
            lit += distance < reach;
        }
    }
    EXPECT_GT(lit, 1000);
    EXPECT_LT(lit, kWidth * kHeight - 100);
}

TEST(AreaLightTruth, WhatDoesNotCastHidesNothing) {
    const Light light = directional_light(kSlanted, 0.1);
    Mesh caster = half_plane(light, 0.5, -2.5);
    const auto darkest = [&](bool casts) {
        caster.casts = casts;
        const auto values = truth(made::scene_of({caster, made::ground(0, 9)}), light, 64);
        return *std::min_element(values.begin(), values.end());
    };
    EXPECT_EQ(darkest(true), 0);
    EXPECT_EQ(darkest(false), 1);
}

TEST(AreaLightTruth, WhatMovesIsTheSameMeshElsewhere) {
    const double angle = 0.4;
    const glm::dmat4 world_from_mover({std::cos(angle), 0, -std::sin(angle), 0}, {0, 1, 0, 0},
                                      {std::sin(angle), 0, std::cos(angle), 0}, {0.3, 0.1, -0.2, 1});
    std::vector<Mesh> moving = made::box({-0.2f, 0, -0.1f}, {0.2f, 0.3f, 0.1f});
    std::vector<Mesh> moved = moving;
    for (size_t i = 0; i < moving.size(); ++i) {
        moving[i].mover = 1;
        for (Vertex& vertex : moved[i].vertices) {
            const double x = vertex.position.x;
            const double z = vertex.position.z;
            vertex.position =
                glm::vec3(glm::dvec3(std::cos(angle) * x + std::sin(angle) * z + 0.3, vertex.position.y + 0.1,
                                     std::cos(angle) * z - std::sin(angle) * x - 0.2));
        }
    }
    moving.push_back(made::ground(0, 9));
    moved.push_back(made::ground(0, 9));
    const Light light = directional_light(kSlanted, 0.1);
    const SceneState here{kCamera, light, {glm::dmat4(1), glm::dmat4(1)}};
    const SceneState there{kCamera, light, {glm::dmat4(1), world_from_mover}};
    const auto draw = [](const std::vector<Mesh>& meshes, const SceneState& state) {
        return area_light_visibility(made::scene_of(meshes), state, kWidth, kHeight, 64, 2);
    };
    const std::vector<float> by_hand = draw(moved, here);
    EXPECT_EQ(draw(moving, there), by_hand);
    EXPECT_NE(draw(moving, here), by_hand);
}

TEST(AreaLightTruth, IsTheSameOnAnyNumberOfThreads) {
    const Light light = light_of(Light::Kind::spot);
    std::vector<Mesh> meshes = made::box({-0.2f, 0, -0.1f}, {0.2f, 0.3f, 0.1f});
    meshes.push_back(made::ground(0, 9));
    const Scene scene = made::scene_of(meshes);
    const std::vector<float> one = truth(scene, light, 100, kCamera, 1);
    EXPECT_EQ(one, truth(scene, light, 100, kCamera, 2));
    EXPECT_EQ(one, truth(scene, light, 100, kCamera, 3));
    EXPECT_GT(std::count_if(one.begin(), one.end(), [](float v) { return v > 0 && v < 1; }), 100);
}

// A convex body hides nothing of a light that is all above the facet at hand, wherever in the world it is.
TEST(AreaLightTruth, AClosedBodyHasNoAcne) {
    const Direction direction{40, 35};
    const Basis basis = basis_towards(direction);
    for (const glm::dvec3& centre : {glm::dvec3(0), glm::dvec3(300, 100, -2000)}) {
        for (const float radius : {0.3f, 1.0f, 50.0f}) {
            Mesh sphere = made::sphere(radius, 48);
            for (Vertex& vertex : sphere.vertices) vertex.position += glm::vec3(centre);
            const Scene scene = made::scene_of({sphere});
            const Camera camera =
                made::camera_at(centre + 4.0 * radius * basis.back, direction, 0.01 * radius, 50 * radius);
            for (const double half_tangent : {0.0, 0.1}) {
                const std::vector<float> values = truth(scene, directional_light(direction, half_tangent), 16, camera);
                int wrong = 0;
                for (int row = 0; row < kHeight; ++row) {
                    for (int column = 0; column < kWidth; ++column) {
                        // Facets near the rim lean away from a part of the square; a point is above or below all at once.
                        const double rim_px = kHeight / 2.0 * std::sqrt(3.0 / 15);
                        const bool rim =
                            std::hypot(column + 0.5 - kWidth / 2.0, row + 0.5 - kHeight / 2.0) > 0.85 * rim_px;
                        wrong += (half_tangent == 0 || !rim) && values[row * kWidth + column] < 1;
                    }
                }
                EXPECT_EQ(wrong, 0) << "radius " << radius << ", half-tangent " << half_tangent;
            }
        }
    }
}

TEST(AreaLightTruth, GrazingLightLeavesAPlaneLit) {
    Mesh plane = made::ground(0, 9);
    plane.casts = true;
    const Scene scene = made::scene_of({plane});
    for (const double elevation : {1.0, 6.0, 45.0, 90.0}) {
        // The lowest point of the square stands half of the light's elevation high.
        const double half_tangent = 0.5 * std::tan(elevation * std::numbers::pi / 180);
        const std::vector<float> values =
            truth(scene, directional_light({33, elevation}, std::min(half_tangent, 0.5)), 64);
        EXPECT_EQ(std::count(values.begin(), values.end(), 1.0f), kWidth * kHeight) << elevation;
    }
}

TEST(AreaLightTruth, APlaneHidesWhatIsBelowItsHorizon) {
    // In tangents of its height above the horizon the square stands from −0.05 to 0.15: a quarter of it is below.
    Mesh plane = made::ground(0, 9);
    plane.casts = true;
    const double tangent = 0.1;
    const double elevation_deg = std::atan(tangent / 2) * 180 / std::numbers::pi;
    const std::vector<float> values =
        truth(made::scene_of({plane}), directional_light({0, elevation_deg}, tangent), 1024);
    for (const float value : values) ASSERT_NEAR(value, 0.75, 1.0 / 32);
}

TEST(AreaLightTruth, BothSidesOfASurfaceAreSeen) {
    const Light from_above = directional_light({0, 90}, 0.1);
    const Scene scene = made::scene_of({made::polygon({{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}}, true)});
    for (const float value : truth(scene, from_above, 16)) ASSERT_EQ(value, 1);
    const Camera from_below = made::camera_at({0, -1, 0}, {0, -90});
    for (const float value : truth(scene, from_above, 16, from_below)) ASSERT_EQ(value, 0);
}

TEST(AreaLightTruth, NothingIsLit) {
    const Light light = directional_light(kSlanted, 0.1);
    Mesh flat = made::polygon({{-1, 0.5f, 0}, {0, 0.5f, 0}, {1, 0.5f, 0}}, true);
    flat.indices.insert(flat.indices.end(), {0, 0, 0, 1, 1, 2});
    for (const Scene& scene : {Scene{}, made::scene_of({Mesh{}}), made::scene_of({flat}),
                               made::scene_of({flat, Mesh{}, made::ground(0, 9)})}) {
        for (const float value : truth(scene, light, 16)) ASSERT_EQ(value, 1);
    }
}

TEST(AreaLightTruth, SeesFromNearToFar) {
    // The same ground is seen where it lies between the two planes alone.
    const Light from_below = directional_light({0, -60}, 0);
    const Scene scene = made::scene_of({made::ground(0, 9)});
    for (const auto& [near, far, seen] : {std::tuple{0.5, 1.5, true}, {1.1, 2.0, false}, {0.1, 0.9, false}}) {
        Camera camera = kCamera;
        camera.near = near;
        camera.far = far;
        for (const float value : truth(scene, from_below, 1, camera)) ASSERT_EQ(value, seen ? 0 : 1);
    }
}

}  // namespace
}  // namespace stairstep
