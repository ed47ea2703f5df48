#include "renderer/truth/caster_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "stimuli/random.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

glm::dvec3 random_point(Random& random, double reach) {
    return {reach * (2 * random.uniform() - 1), reach * (2 * random.uniform() - 1), reach * (2 * random.uniform() - 1)};
}

glm::dvec3 random_normal(Random& random) {
    return glm::normalize(glm::dvec3(random.normal(), random.normal(), random.normal()));
}

/// A few triangles, each some tenths wide, in a cube of side 2.
WorldMesh random_triangles(Random& random, int count) {
    WorldMesh mesh;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 middle = random_point(random, 1);
        for (int corner = 0; corner < 3; ++corner) {
            mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(glm::vec3(middle + random_point(random, 0.3)));
        }
    }
    return mesh;
}

/// Whether from + t·way, t in (0, 1), crosses the triangle: the signs of five volumes.
bool crosses(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& from, const glm::dvec3& way) {
    const auto volume = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return glm::dot(a, glm::cross(b, c));
    };
    const glm::dvec3 a = triangle[0] - from;
    const glm::dvec3 b = triangle[1] - from;
    const glm::dvec3 c = triangle[2] - from;
    const double first = volume(way, a, b);
    const double second = volume(way, b, c);
    const double third = volume(way, c, a);
    const bool inside = (first > 0 && second > 0 && third > 0) || (first < 0 && second < 0 && third < 0);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double t = glm::dot(normal, a) / glm::dot(normal, way);
    return inside && t > 0 && t < 1;
}

Light random_light(Random& random, Light::Kind kind) {
    const Direction direction{360 * random.uniform(), 180 * random.uniform() - 90};
    if (kind == Light::Kind::directional) return directional_light(direction, 0.3 * random.uniform());
    return spot_light(4.0 * basis_towards(direction).back, glm::dvec3(0), 0.8 * random.uniform(), 60);
}

class CasterTrees : public testing::TestWithParam<Light::Kind> {};

TEST_P(CasterTrees, NeverMissWhatHidesTheLight) {
    constexpr double kTolerance = 1e-6;
    Random random(3);
    int certain = 0;
    int on_triangles = 0;
    for (int scene = 0; scene < 60; ++scene) {
        const WorldMesh mesh = random_triangles(random, 1 + static_cast<int>(random.below(40)));
        const Light light = random_light(random, GetParam());
        const CasterTree tree({mesh}, light);
        for (int i = 0; i < 60; ++i) {
            // In the open, or on one of the triangles.
            glm::dvec3 point = random_point(random, 1.2);
            glm::dvec3 normal = random_normal(random);
            if (i % 2) {
                const auto [a, b, c] = mesh.triangle(random.below(mesh.triangle_count()));
                point = (a + 2.0 * b + 3.0 * c) / 6.0;
                normal = glm::normalize(glm::cross(b - a, c - a));
            }
            const glm::dvec3 to_light = light.kind == Light::Kind::spot ? light.position - point : light.basis.back;
            if (glm::dot(normal, to_light) < 0) normal = -normal;
            if (tree.may_hide_light(point, normal, kTolerance)) continue;
            ++certain;
            on_triangles += i % 2;
            // The light's rim and what is within, from above the point as rays start.
            const glm::dvec3 origin = point + kTolerance * normal;
            for (int sample = 0; sample < 40; ++sample) {
                const auto aside = [&] { return light.half_side * std::clamp(3 * random.uniform() - 1.5, -1.0, 1.0); };
                const glm::dvec3 across = aside() * light.basis.right + aside() * light.basis.up;
                const glm::dvec3 way = light.kind == Light::Kind::spot
                                           ? light.position + across - origin
                                           : 100.0 * (light.basis.back + across / light.distance);
                for (size_t t = 0; t < mesh.triangle_count(); ++t) {
                    ASSERT_FALSE(crosses(mesh.triangle(t), origin, way)) << scene << " " << i;
                }
            }
        }
    }
    // A test that is always unsure would pass too.
    EXPECT_GT(certain, 600);
    EXPECT_GT(on_triangles, 300);
}

INSTANTIATE_TEST_SUITE_P(OfEachLight, CasterTrees, testing::Values(Light::Kind::directional, Light::Kind::spot),
                         [](const auto& info) { return info.param == Light::Kind::spot ? "spot" : "directional"; });

TEST(CasterTree, IsSureRightBesideThePenumbra) {
    // A square caster from −1 to 1 at y = 2 under a light straight above: the penumbra ends at 1 + 0.1·2.
    const WorldMesh square{{{-1, 2, -1}, {-1, 2, 1}, {1, 2, 1}, {1, 2, -1}}, {0, 1, 2, 0, 2, 3}, true};
    const CasterTree tree({square}, directional_light({0, 90}, 0.1));
    EXPECT_TRUE(tree.may_hide_light({1.199, 0, 0}, {0, 1, 0}, 1e-5));
    EXPECT_FALSE(tree.may_hide_light({1.201, 0, 0}, {0, 1, 0}, 1e-5));
    EXPECT_EQ(tree.largest_coordinate(), 2);
}

TEST(CasterTree, ABodyDoesNotHideTheLightFromItself) {
    Mesh sphere = made::sphere(1, 24);
    const std::vector<WorldMesh> meshes = world_meshes(made::scene_of({sphere}), {});
    const Light light = directional_light({0, 90}, 0.1);
    const CasterTree tree(meshes, light);
    int certain = 0;
    int facing = 0;
    for (size_t i = 0; i < meshes[0].triangle_count(); ++i) {
        const auto [a, b, c] = meshes[0].triangle(i);
        const glm::dvec3 middle = (a + b + c) / 3.0;
        const glm::dvec3 across = glm::cross(b - a, c - a);
        if (!(glm::length(across) > 0)) continue;
        const glm::dvec3 normal = glm::normalize(across * glm::dot(across, middle));
        if (normal.y < 0.2) continue;
        ++facing;
        certain += !tree.may_hide_light(middle, normal, 1e-5);
    }
    EXPECT_GT(facing, 500);
    EXPECT_EQ(certain, facing);
}

TEST(CasterTree, WithoutCastersNothingHides) {
    WorldMesh mesh{{{-1, 2, -1}, {-1, 2, 1}, {1, 2, 1}}, {0, 1, 2}, false};
    const Light light = directional_light({0, 90}, 0.1);
    EXPECT_FALSE(CasterTree({mesh}, light).may_hide_light({-0.5, 0, 0.5}, {0, 1, 0}, 1e-5));
    EXPECT_EQ(CasterTree({mesh}, light).largest_coordinate(), 0);
    mesh.casts = true;
    EXPECT_TRUE(CasterTree({mesh}, light).may_hide_light({-0.5, 0, 0.5}, {0, 1, 0}, 1e-5));
}

}  // namespace
}  // namespace stairstep
