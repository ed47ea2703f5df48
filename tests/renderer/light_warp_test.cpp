// A warped map against its closed forms.
#include "renderer/light_warp.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "renderer/shadow_map_shape.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr double kLeast = 1e-9;

/// Light space is world space, its depth along −z.
LightFrustum frustum_with(const LightWarp& warp) {
    LightFrustum frustum;
    frustum.basis = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    frustum.low = {-10, -10};
    frustum.high = {10, 10};
    frustum.nearest = 0;
    frustum.farthest = 5;
    frustum.warp = warp;
    return frustum;
}

glm::dvec3 in_texels(const glm::dmat4& matrix, const glm::dvec3& point) {
    const glm::dvec4 homogeneous = matrix * glm::dvec4(point, 1);
    return glm::dvec3(homogeneous) / homogeneous.w;
}

/// The header's anchor: n = 3 over d = 3, so w is 2 at the far end.
const std::vector<glm::dvec2> kTrapezium{{-1, 0}, {1, 0}, {2, 3}, {-2, 3}};

TEST(LightWarp, HasThePapersDistance) {
    const LightWarp warp = lispsm_warp(kTrapezium, {1, 1, 4, 0, 0}, kLeast);
    EXPECT_NEAR(1 / warp.curvature, 3, 1e-12);
    EXPECT_NEAR(warp.largest_w(), 2, 1e-8);
    EXPECT_NEAR(warp.texel_ratio().x, 2, 1e-8);
    EXPECT_NEAR(warp.texel_ratio().y, 4, 1e-8);
    // Half as much of the view across the light, twice as far away is the centre.
    EXPECT_NEAR(1 / lispsm_warp(kTrapezium, {0.5, 1, 4, 0, 0}, kLeast).curvature, 6, 1e-12);
    EXPECT_FALSE(lispsm_warp(kTrapezium, {0, 1, 4, 0, 0}, kLeast).warps());
    EXPECT_NEAR(1 / lispsm_warp(kTrapezium, {1, 1, 4, 0, 10}, kLeast).curvature, 20, 1e-12);
}

TEST(LightWarp, MapsTheBodysCornersToTheMaps) {
    ShadowMapShape shape = map_of_size(frustum_with(lispsm_warp(kTrapezium, {1, 1, 4, 0, 0}, kLeast)), 512);
    shape.height = 256;
    const glm::dmat4 matrix = texel_from_world(shape);
    for (const double z : {0.0, -2.5, -4.999}) {
        const std::vector<glm::dvec2> corners{{0, 0}, {512, 0}, {512, 256}, {0, 256}};
        for (size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec3 texel = in_texels(matrix, {kTrapezium[i], z});
            EXPECT_NEAR(texel.x, corners[i].x, 1e-5);
            EXPECT_NEAR(texel.y, corners[i].y, 1e-5);
            EXPECT_NEAR(texel.z, -z / 5 / (i < 2 ? 1 : 2), 1e-8);
        }
    }
}

RC_GTEST_PROP(LightWarp, HoldsTheBodyAndNoMore, ()) {
    const auto number = [](int low, int high) { return *rc::gen::inRange(low * 1000, high * 1000) / 1000.0; };
    std::vector<glm::dvec2> body;
    for (int i = 0; i < 5; ++i) body.emplace_back(number(-20, 20), number(-20, 20));
    const double near = number(1, 50);
    const WarpView view{number(0, 1), near, near + number(0, 100), number(-30, 30), 0};
    const double margin = 1e-6;
    const ShadowMapShape shape = map_of_size(frustum_with(lispsm_warp(body, view, margin)), 1000);
    RC_PRE(shape.frustum.warp.warps());
    const glm::dmat4 matrix = texel_from_world(shape);
    glm::dvec2 low(INFINITY);
    glm::dvec2 high(-INFINITY);
    for (const glm::dvec2& corner : body) {
        const glm::dvec2 texel(in_texels(matrix, {corner, -1}));
        low = glm::min(low, texel);
        high = glm::max(high, texel);
    }
    const LightWarp& warp = shape.frustum.warp;
    // The margin in texels, where they are smallest.
    const glm::dvec2 slack = 1000 * 1.01 * margin * warp.texel_ratio() / warp.extent() + 1e-9;
    for (const int axis : {0, 1}) {
        RC_ASSERT(low[axis] >= 0 && low[axis] <= slack[axis]);
        RC_ASSERT(high[axis] <= 1000 && high[axis] >= 1000 - slack[axis]);
    }
}

TEST(LightWarp, TexelsHaveTheStatedSizes) {
    const ShadowMapShape shape = map_of_size(frustum_with(lispsm_warp(kTrapezium, {1, 1, 4, 0, 0}, kLeast)), 300);
    const glm::dmat4 matrix = texel_from_world(shape);
    const auto texels_per_unit = [&](double y) {
        constexpr double kStep = 1e-5;
        const glm::dvec3 here = in_texels(matrix, {0, y, -1});
        return glm::dvec2(in_texels(matrix, {kStep, y, -1}).x - here.x,
                          in_texels(matrix, {0, y + kStep, -1}).y - here.y) /
               kStep;
    };
    const glm::dvec2 near = texels_per_unit(0);
    for (const int axis : {0, 1}) {
        EXPECT_NEAR(near[axis] * shape.smallest_texel()[axis], 1, 1e-4);
        EXPECT_NEAR(texels_per_unit(3)[axis] * shape.texel()[axis], 1, 1e-4);
        // In between: by 1/w and 1/w².
        EXPECT_NEAR(texels_per_unit(1.5)[axis] / near[axis], axis == 0 ? 1 / 1.5 : 1 / 2.25, 1e-4);
    }
}

// As the centre moves away the warp becomes the plain map of the body's bounds.
TEST(LightWarp, FromFarAwayIsNoWarp) {
    LightFrustum plain = frustum_with({});
    plain.low = {-2, 0};
    plain.high = {2, 3};
    const glm::dmat4 expected = texel_from_world(map_of_size(plain, 512));
    const glm::dmat4 warped =
        texel_from_world(map_of_size(frustum_with(lispsm_warp(kTrapezium, {1e-9, 1, 4, 0.7, 0}, 1e-12)), 512));
    for (const glm::dvec3 point : {glm::dvec3(-2, 0, 0), glm::dvec3(1, 2, -3), glm::dvec3(0.3, 1, -4.5)}) {
        for (const int axis : {0, 1, 2}) {
            EXPECT_NEAR(in_texels(warped, point)[axis], in_texels(expected, point)[axis], 1e-5);
        }
    }
}

// What shaders/receiver.glsl does with the inverse transpose, against differences of depth on the plane.
TEST(LightWarp, PlanesStayPlanes) {
    const glm::dmat4 matrix =
        texel_from_world(map_of_size(frustum_with(lispsm_warp(kTrapezium, {1, 1, 4, 0.5, 0}, kLeast)), 512));
    const glm::dmat4 plane_matrix = glm::transpose(glm::inverse(matrix));
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.4, -0.3, 0.8));
    const glm::dvec3 middle(0.2, 1.1, -2);
    const glm::dvec4 plane = plane_matrix * glm::dvec4(normal, -glm::dot(normal, middle));
    const glm::dvec2 slope = -glm::dvec2(plane) / plane.z;
    const glm::dvec3 at = in_texels(matrix, middle);
    const glm::dvec3 u = glm::cross(normal, glm::dvec3(0, 0, 1));
    const glm::dvec3 v = glm::cross(normal, u);
    // Not only near by: all of it.
    for (const double a : {-0.9, 0.01, 0.7}) {
        for (const double b : {-0.8, -0.01, 0.6}) {
            const glm::dvec3 other = in_texels(matrix, middle + a * u + b * v);
            EXPECT_NEAR(other.z - at.z, glm::dot(slope, glm::dvec2(other - at)), 1e-12);
        }
    }
}

// A view along a ground under a slanting light.
SceneState view_along_ground() {
    SceneState state;
    state.camera = camera_looking_at({0, 2, 0}, {0, 1, -10}, 45, 1, 60);
    state.light = directional_light({60, 40}, 0);
    return state;
}

Scene long_ground() {
    std::vector<Mesh> meshes = made::box({-0.3f, 0, -60}, {0.3f, 2, 10});
    meshes.push_back(made::ground(0, 80));
    meshes.push_back(made::polygon({{-80, 4, -80}, {80, 4, -80}, {80, 4, 80}, {-80, 4, 80}}, true));
    return made::scene_of(meshes);
}

TEST(LightWarp, LiesAlongTheViewAndHoldsWhatIsSeen) {
    const SceneState state = view_along_ground();
    const double reach = 0.2;
    const LightFrustum frustum = fit_light_frustum(
        extents_of(long_ground()), state, 1.5, Fit::axis_aligned, [&](auto&) { return reach; }, Warp::lispsm);
    ASSERT_TRUE(frustum.warp.warps());
    EXPECT_NEAR(glm::dot(frustum.basis.right, state.camera.basis.back), 0, 1e-12);
    EXPECT_GT(-glm::dot(frustum.basis.up, state.camera.basis.back), 0);
    EXPECT_NEAR(glm::dot(glm::cross(frustum.basis.right, frustum.basis.up), frustum.basis.back), 1, 1e-12);
    EXPECT_LE(glm::dot(frustum.basis.back - state.light.basis.back, frustum.basis.back), 1e-12);

    // All that the camera sees of the ground, and the filters around it.
    const ShadowMapShape shape = map_of_size(frustum, 256);
    const glm::dmat4 matrix = texel_from_world(shape);
    const glm::dmat4 clip = clip_from_world(state.camera, 1.5);
    int seen = 0;
    for (double x = -60; x <= 60; x += 0.9) {
        for (double z = -60; z <= 0; z += 0.9) {
            const glm::dvec4 in_view = clip * glm::dvec4(x, 0, z, 1);
            if (std::abs(in_view.x) > in_view.w || std::abs(in_view.y) > in_view.w || in_view.z > in_view.w) continue;
            ++seen;
            for (const double side : {-reach, reach}) {
                const glm::dvec3 place = glm::dvec3(x, 0, z) + side * (frustum.basis.right + frustum.basis.up);
                const glm::dvec3 texel = in_texels(matrix, place);
                EXPECT_GE(std::min(texel.x, texel.y), 0);
                EXPECT_LE(std::max(texel.x, texel.y), 256);
            }
        }
    }
    EXPECT_GT(seen, 500);
    // A rectangle around a view is some half empty; the warp spends its texels near by.
    EXPECT_GT(frustum.warp.texel_ratio().y, 4);
}

TEST(LightWarp, VanishesAlongTheViewAndForSpots) {
    SceneState state = view_along_ground();
    const SceneExtents extents = extents_of(long_ground());
    const auto warp_of = [&] {
        return fit_light_frustum(
                   extents, state, 1.5, Fit::axis_aligned, [](auto&) { return 0.1; }, Warp::lispsm)
            .warp;
    };
    for (const double sign : {1.0, -1.0}) {
        state.light.basis = basis_towards(direction_of(sign * state.camera.basis.back));
        // Directions are rounded: along the view to some 1e-8.
        EXPECT_FALSE(warp_of().warps()) << sign;
        state.light.basis = basis_towards(direction_of(sign * state.camera.basis.back + 0.01 * state.camera.basis.up));
        const LightWarp nearly = warp_of();
        EXPECT_TRUE(nearly.warps() && nearly.largest_w() < 1.1) << sign << " " << nearly.largest_w();
    }
    state.light = spot_light({3, 6, -5}, {0, 0, -8}, 0.1, 60);
    EXPECT_FALSE(warp_of().warps());
}

TEST(LightWarp, TheLawsMapHasNoTexelThatItDoesNotAllow) {
    const SceneState state = view_along_ground();
    const auto frustum_of = [&](Warp warp) {
        return fit_light_frustum(
            extents_of(long_ground()), state, 1.5, Fit::axis_aligned, [](auto&) { return 0.3; }, warp);
    };
    const SizeRequest request{3.47, 0.3, 0, 0, 8192};
    const ShadowMapShape shape = map_by_law(frustum_of(Warp::lispsm), request);
    EXPECT_EQ(shape.limit, ShadowMapShape::Limit::law);
    for (const int axis : {0, 1}) {
        EXPECT_LE(shape.texel()[axis], 0.3 / 3.47);
        EXPECT_GE(shape.texel()[axis], 0.3 / 3.47 * 0.99);
    }
    const ShadowMapShape capped = map_by_law(frustum_of(Warp::lispsm), {3.47, 0.3, 0, 0, 200});
    EXPECT_EQ(capped.limit, ShadowMapShape::Limit::largest_size);
    EXPECT_LE(std::max(capped.width, capped.height), 200);
}

}  // namespace
}  // namespace stairstep
