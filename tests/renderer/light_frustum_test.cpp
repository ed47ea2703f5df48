#include <gtest/gtest.h>

#include "renderer/light_frustum.h"
#include "stimuli/error.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr double kSlope = 3.47;

Scene slab() {
    return made::scene_of(made::box({-2, 0, -0.5f}, {2, 0.3f, 0.5f}));
}

TEST(LightFrustum, HoldsAllCastersWithTheMargin) {
    const Scene scene = slab();
    const double margin = 0.2;
    for (const Direction light : {Direction{0, 90}, Direction{30, 45}, Direction{-120, 5}}) {
        const LightFrustum frustum = fit_light_frustum(scene, light, margin);
        const ShadowMapShape shape = map_of_size(frustum, 256);
        const glm::mat4 matrix = texel_from_world(shape);
        glm::dvec2 low(INFINITY);
        glm::dvec2 high(-INFINITY);
        for (const Mesh& mesh : scene.meshes) {
            for (const Vertex& vertex : mesh.vertices) {
                const glm::vec4 texel = matrix * glm::vec4(vertex.position, 1);
                EXPECT_GT(texel.z, 0);
                EXPECT_LT(texel.z, 1);
                low = glm::min(low, glm::dvec2(texel));
                high = glm::max(high, glm::dvec2(texel));
            }
        }
        // Tight: the casters touch the margin on every side.
        for (const int axis : {0, 1}) {
            EXPECT_NEAR(low[axis], margin / shape.texel()[axis], 1e-3);
            EXPECT_NEAR(high[axis], 256 - margin / shape.texel()[axis], 1e-3);
        }
    }
}

TEST(LightFrustum, DepthGrowsAwayFromTheLight) {
    const Direction light{30, 45};
    const glm::mat4 matrix = texel_from_world(map_of_size(fit_light_frustum(slab(), light, 0.1), 64));
    const glm::dvec3 to_light = basis_towards(light).back;
    EXPECT_LT((matrix * glm::vec4(glm::vec3(0.1 * to_light), 1)).z, (matrix * glm::vec4(0, 0, 0, 1)).z);
}

// A caster in one plane across the light has no depth of its own; the map still must tell it from nothing.
TEST(LightFrustum, AFlatCasterHasDepth) {
    const Scene scene = made::scene_of({made::polygon({{-1, 2, -1}, {-1, 2, 1}, {1, 2, 1}}, true)});
    const LightFrustum frustum = fit_light_frustum(scene, {0, 90}, 0.1);
    EXPECT_GT(frustum.farthest, frustum.nearest);
}

TEST(MapByLaw, SizesAreTheLawsAxisByAxis) {
    for (const double radius : {0.02, 0.1, 0.31}) {
        const LightFrustum frustum = fit_light_frustum(slab(), {30, 60}, radius);
        const ShadowMapShape shape = map_by_law(frustum, {kSlope, radius, 0, 0, 8192});
        EXPECT_EQ(shape.width, shadow_map_size({kSlope, radius, frustum.extent().x, 0, 8192}).texels);
        EXPECT_EQ(shape.height, shadow_map_size({kSlope, radius, frustum.extent().y, 0, 8192}).texels);
        EXPECT_NE(shape.width, shape.height) << "a slab isn't square";
        EXPECT_EQ(shape.limit, ShadowMapShape::Limit::law);
        for (const int axis : {0, 1}) {
            EXPECT_NEAR(radius / shape.texel()[axis], kSlope, 1e-9);
            EXPECT_LE(shape.frustum.low[axis], frustum.low[axis] + 1e-9);
            EXPECT_GE(shape.frustum.high[axis], frustum.high[axis] - 1e-9);
            // Never a whole texel too many.
            EXPECT_LT(shape.frustum.extent()[axis] - frustum.extent()[axis], shape.texel()[axis]);
        }
    }
}

TEST(MapByLaw, TheScreenAndTheLargestSizeBoundIt) {
    const LightFrustum frustum = fit_light_frustum(slab(), {30, 60}, 0.01);
    const ShadowMapShape screen = map_by_law(frustum, {kSlope, 0.01, 0, 0.02, 8192});
    EXPECT_EQ(screen.limit, ShadowMapShape::Limit::screen);
    EXPECT_NEAR(screen.texel().x, 0.02, 1e-12);
    const ShadowMapShape capped = map_by_law(frustum, {kSlope, 0.01, 0, 0, 100});
    EXPECT_EQ(capped.limit, ShadowMapShape::Limit::largest_size);
    EXPECT_EQ(capped.width, 100);
}

TEST(MapByLaw, NonsenseIsAnInputError) {
    const LightFrustum frustum = fit_light_frustum(slab(), {30, 60}, 0.1);
    for (const double radius : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
        EXPECT_THROW(map_by_law(frustum, {kSlope, radius, 0, 0, 8192}), InputError) << radius;
    }
}

}  // namespace
}  // namespace stairstep
