#include "renderer/light_frustum.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "renderer/shadow_map_shape.h"
#include "stimuli/error.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr double kSlope = 3.47;

Scene slab() {
    return made::scene_of(made::box({-2, 0, -0.5f}, {2, 0.3f, 0.5f}));
}

glm::dvec3 in_texels(const glm::dmat4& matrix, const glm::dvec3& point) {
    const glm::dvec4 homogeneous = matrix * glm::dvec4(point, 1);
    return glm::dvec3(homogeneous) / homogeneous.w;
}

void expect_tight(const Scene& scene, const LightFrustum& frustum) {
    const glm::dmat4 matrix = texel_from_world(map_of_size(frustum, 256));
    glm::dvec3 low(INFINITY);
    glm::dvec3 high(-INFINITY);
    for (const Mesh& mesh : scene.meshes) {
        for (const Vertex& vertex : mesh.vertices) {
            low = glm::min(low, in_texels(matrix, vertex.position));
            high = glm::max(high, in_texels(matrix, vertex.position));
        }
    }
    for (const int axis : {0, 1}) {
        EXPECT_NEAR(low[axis], 0, 0.01);
        EXPECT_NEAR(high[axis], 256, 0.01);
        EXPECT_GE(low[axis], 0);
        EXPECT_LE(high[axis], 256);
    }
    EXPECT_GT(low.z, 0);
    EXPECT_LT(high.z, 1);
}

TEST(LightFrustum, HoldsAllCastersTightly) {
    for (const Direction direction : {Direction{0, 90}, Direction{30, 45}, Direction{-120, 5}}) {
        SCOPED_TRACE(direction.azimuth_deg);
        expect_tight(slab(), made::fitted(slab(), direction));
        expect_tight(slab(), made::fitted(slab(), spot_light(9.0 * basis_towards(direction).back, {}, 0.1, 40)));
    }
}

TEST(LightFrustum, DepthGrowsAwayFromTheLight) {
    const Direction direction{30, 45};
    const glm::dvec3 towards = basis_towards(direction).back;
    for (const Light& light : {directional_light(direction, 0.1), spot_light(9.0 * towards, {}, 0.1, 40)}) {
        const glm::dmat4 matrix = texel_from_world(map_of_size(made::fitted(slab(), light), 64));
        EXPECT_LT(in_texels(matrix, 0.1 * towards).z, in_texels(matrix, {}).z);
    }
}

// light.h's half-widths from stored depths alone.
TEST(LightFrustum, SoftnessTurnsStoredDepthsIntoHalfWidths) {
    const Direction direction{30, 45};
    const glm::dvec3 towards = basis_towards(direction).back;
    for (const Light& light : {directional_light(direction, 0.1), spot_light(9.0 * towards, {}, 0.2, 40)}) {
        const LightFrustum frustum = made::fitted(slab(), light);
        const glm::dmat4 matrix = texel_from_world(map_of_size(frustum, 64));
        const glm::dvec3 caster = 0.1 * towards;
        const glm::dvec3 receiver = -0.7 * towards;
        const double apart = in_texels(matrix, receiver).z - in_texels(matrix, caster).z;
        const double expected = light.kind == Light::Kind::spot
                                    ? 0.2 * (1 / depth_along(light, caster) - 1 / depth_along(light, receiver))
                                    : 0.1 * 0.8;
        EXPECT_NEAR(frustum.softness * apart, expected, 1e-12);
    }
}

// A caster in one plane across the light has no depth of its own; the map still must tell it from nothing.
TEST(LightFrustum, AFlatCasterHasDepth) {
    const Scene scene = made::scene_of({made::polygon({{-1, 2, -1}, {-1, 2, 1}, {1, 2, 1}}, true)});
    const LightFrustum frustum = made::fitted(scene, Direction{0, 90});
    EXPECT_GT(frustum.farthest, frustum.nearest);
}

TEST(LightFrustum, NothingToCastIsNoError) {
    // All corners in one point are hardly more than nothing.
    const Mesh point = made::polygon({{3, 1, 2}, {3, 1, 2}, {3, 1, 2}}, true);
    const Mesh origin = made::polygon({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, true);
    for (const Scene& scene : {made::scene_of({}), made::scene_of({made::ground(0, 5)}), made::scene_of({point}),
                               made::scene_of({origin})}) {
        const LightFrustum frustum = made::fitted(scene, Direction{30, 45});
        EXPECT_GT(frustum.extent().x, 0);
        EXPECT_GT(frustum.extent().y, 0);
        EXPECT_GT(frustum.farthest, frustum.nearest);
        EXPECT_TRUE(std::isfinite(frustum.softness));
    }
}

// A row of boxes of which the camera sees the middle one: the map covers what may shade what it sees.
TEST(LightFrustum, LeavesOutWhatCanShadeNothingVisible) {
    std::vector<Mesh> meshes;
    for (const float x : {-20.0f, 0.0f, 20.0f}) {
        for (Mesh& side : made::box({x - 1, 1, -1}, {x + 1, 2, 1})) meshes.push_back(std::move(side));
    }
    meshes.push_back(made::ground(0, 40));
    const Scene scene = made::scene_of(meshes);
    SceneState state;
    // Sees 5·tan 30° of the ground to each side.
    state.camera = made::camera_down({0, 5, 0});
    state.light = directional_light({0, 90}, 0);
    const auto fit = [&](double reach) {
        return fit_light_frustum(extents_of(scene), state, 1, Fit::axis_aligned,
                                 [&](const LightFrustum&) { return reach; });
    };
    const LightFrustum frustum = fit(0.5);
    EXPECT_NEAR(frustum.extent().x, 2 * (5 / std::sqrt(3.0) + 0.5), 1e-3);
    EXPECT_NEAR(fit(1e3).extent().x, 42, 1e-3);
    EXPECT_NEAR(frustum.view_range.x, 3, 1e-9) << "the boxes' tops";
}

// A thin wall seen from straight above, turned by some angle: the smallest map lies along it.
RC_GTEST_PROP(LightFrustum, SmallestRectangleLiesAlongTheWall, ()) {
    const double angle = *rc::gen::inRange(1, 179) * 0.0175;
    const glm::vec3 along(std::cos(angle), 0, std::sin(angle));
    const glm::vec3 across(-along.z, 0, along.x);
    const auto corner = [&](float a, float b) { return a * along + b * across; };
    const Scene scene =
        made::scene_of({made::polygon({corner(-3, -0.5f), corner(3, -0.5f), corner(3, 0.5f), corner(-3, 0.5f)}, true)});
    const Light light = directional_light({0, 90}, 0);
    const LightFrustum smallest = made::fitted(scene, light, Fit::smallest_rectangle);
    const LightFrustum aligned = made::fitted(scene, light, Fit::axis_aligned);
    RC_ASSERT(std::abs(smallest.extent().x * smallest.extent().y - 6) < 1e-3);
    RC_ASSERT(aligned.extent().x * aligned.extent().y > 6 - 1e-3);
    RC_ASSERT(std::abs(glm::dot(smallest.basis.right, smallest.basis.up)) < 1e-12);
    expect_tight(scene, smallest);
}

TEST(MapByLaw, SizesAreTheLawsAxisByAxis) {
    for (const double radius : {0.02, 0.1, 0.31}) {
        const LightFrustum frustum = made::fitted(slab(), Direction{30, 60});
        const ShadowMapShape shape = map_by_law(frustum, {kSlope, radius, 0, 0, 8192});
        EXPECT_NE(shape.width, shape.height) << "a slab isn't square";
        EXPECT_EQ(shape.limit, ShadowMapShape::Limit::law);
        for (const int axis : {0, 1}) {
            const int least = shadow_map_size({kSlope, radius, frustum.extent()[axis], 0, 8192}).texels;
            EXPECT_GE((axis == 0 ? shape.width : shape.height), least);
            EXPECT_LE((axis == 0 ? shape.width : shape.height), least + 1);
            // Finer than the law asks by no more than a texel's rounding to 12 bits.
            EXPECT_GE(radius / shape.texel()[axis], kSlope * (1 - 1e-12));
            EXPECT_LE(radius / shape.texel()[axis], kSlope * (1 + 1.0 / 2048));
            EXPECT_LE(shape.frustum.low[axis], frustum.low[axis]);
            EXPECT_GE(shape.frustum.high[axis], frustum.high[axis] - 1e-12);
        }
    }
}

// As a fitted frustum moves, texels stay where they are.
RC_GTEST_PROP(MapOfTexels, TexelsDontMoveWithTheFrustum, ()) {
    const double texel = representable_texel(std::exp2(*rc::gen::inRange(-300, 100) / 37.0));
    LightFrustum frustum;
    frustum.low = texel * glm::dvec2(*rc::gen::inRange(-90000, 90000), *rc::gen::inRange(-90000, 90000)) / 100.0;
    frustum.high = frustum.low + texel * glm::dvec2(*rc::gen::inRange(1, 90000), *rc::gen::inRange(1, 90000)) / 100.0;
    const ShadowMapShape shape = map_of_texels(frustum, texel, 8192, ShadowMapShape::Limit::law);
    for (const int axis : {0, 1}) {
        const double first = shape.frustum.low[axis] / texel;
        RC_ASSERT(first == std::floor(first));
        RC_ASSERT(shape.texel()[axis] == texel);
        RC_ASSERT(shape.frustum.low[axis] <= frustum.low[axis]);
        RC_ASSERT(shape.frustum.high[axis] >= frustum.high[axis]);
    }
}

TEST(MapByLaw, TheScreenAndTheLargestSizeBoundIt) {
    const LightFrustum frustum = made::fitted(slab(), Direction{30, 60});
    const ShadowMapShape screen = map_by_law(frustum, {kSlope, 0.01, 0, 0.02, 8192});
    EXPECT_EQ(screen.limit, ShadowMapShape::Limit::screen);
    EXPECT_NEAR(screen.texel().x, 0.02, 0.02 / 2048);
    const ShadowMapShape capped = map_by_law(frustum, {kSlope, 0.01, 0, 0, 100});
    EXPECT_EQ(capped.limit, ShadowMapShape::Limit::largest_size);
    EXPECT_LE(capped.width, 100);
    EXPECT_GE(capped.width, 98);
    EXPECT_EQ(map_by_law(frustum, {kSlope, 0.01, 0, 0, 1}).width, 1);
}

TEST(MapByLaw, NonsenseIsAnInputError) {
    const LightFrustum frustum = made::fitted(slab(), Direction{30, 60});
    for (const double radius : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
        EXPECT_THROW(map_by_law(frustum, {kSlope, radius, 0, 0, 8192}), InputError) << radius;
    }
}

}  // namespace
}  // namespace stairstep
