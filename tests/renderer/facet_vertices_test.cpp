#include "renderer/facet_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "stimuli/random.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

using Corners = std::array<std::array<float, 3>, 3>;

/// The least of a triangle's three rotations: equal for the same triangle with the same winding alone.
Corners turned(const Corners& corners) {
    const auto& [a, b, c] = corners;
    return std::min({corners, Corners{b, c, a}, Corners{c, a, b}});
}

template <typename PositionOf>
std::vector<Corners> triangles_of(const std::vector<uint32_t>& indices, PositionOf position_of) {
    std::vector<Corners> triangles;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        Corners corners;
        for (size_t corner = 0; corner < 3; ++corner) {
            const glm::vec3 at = position_of(indices[i + corner]);
            corners[corner] = {at.x, at.y, at.z};
        }
        triangles.push_back(turned(corners));
    }
    return triangles;
}

/// Vertices on a coarse grid, so that many triangles share planes, and some have no area.
Mesh random_mesh(Random& random) {
    Mesh mesh;
    const uint64_t vertices = 3 + random.below(30);
    for (uint64_t i = 0; i < vertices; ++i) {
        const auto place = [&] { return static_cast<float>(random.below(4)) - 1.5f; };
        mesh.vertices.push_back({{place(), place(), place()}, {0, 1, 0}, {0, 0}});
        mesh.vertices.back().uv.x = static_cast<float>(i);
    }
    const uint64_t corners = 3 * (1 + random.below(60));
    for (uint64_t i = 0; i < corners; ++i) mesh.indices.push_back(static_cast<uint32_t>(random.below(vertices)));
    return mesh;
}

TEST(FacetVertices, EachTriangleStaysInItsPlaceWithItsWinding) {
    Random random(7);
    for (int run = 0; run < 300; ++run) {
        const Mesh mesh = random_mesh(random);
        const FacetMesh facets = facet_mesh(mesh);
        ASSERT_EQ(triangles_of(facets.indices, [&](uint32_t i) { return facets.vertices[i].vertex.position; }),
                  triangles_of(mesh.indices, [&](uint32_t i) { return mesh.vertices[i].position; }));
        // What rides on vertices rides along.
        for (const FacetVertex& vertex : facets.vertices) {
            const auto original = static_cast<size_t>(vertex.vertex.uv.x);
            EXPECT_EQ(vertex.vertex.position, mesh.vertices[original].position);
        }
    }
}

TEST(FacetVertices, TheLastVertexHasTheTrianglesNormal) {
    Random random(8);
    int flat = 0;
    for (int run = 0; run < 300; ++run) {
        const FacetMesh facets = facet_mesh(random_mesh(random));
        for (size_t i = 0; i < facets.indices.size(); i += 3) {
            const auto position = [&](size_t corner) {
                return glm::dvec3(facets.vertices[facets.indices[i + corner]].vertex.position);
            };
            const glm::dvec3 normal = glm::cross(position(1) - position(0), position(2) - position(0));
            const glm::dvec3 facet = facets.vertices[facets.indices[i + 2]].facet;
            if (glm::length(normal) == 0) {
                EXPECT_EQ(facet, glm::dvec3(0));
                ++flat;
            } else {
                EXPECT_LT(glm::distance(facet, glm::normalize(normal)), 1e-6);
            }
        }
    }
    EXPECT_GT(flat, 100);
}

TEST(FacetVertices, AddsVerticesOnlyWhereItMust) {
    // Each side of a box has two triangles of one plane and four vertices.
    for (const Mesh& side : made::box({-1, 0, 2}, {3, 1, 4})) EXPECT_EQ(facet_mesh(side).vertices.size(), 4u);
    // A smooth mesh has two triangles a vertex, each with a plane of its own or shared.
    const Mesh sphere = made::sphere(1, 12);
    EXPECT_LE(facet_mesh(sphere).vertices.size(), 2 * sphere.vertices.size());
    Random random(9);
    for (int run = 0; run < 100; ++run) {
        const Mesh mesh = random_mesh(random);
        EXPECT_LE(facet_mesh(mesh).vertices.size(), mesh.vertices.size() + mesh.indices.size() / 3);
    }
}

TEST(FacetVertices, LeavesOutTrianglesThatAreNotFinite) {
    Mesh mesh = made::polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, true);
    mesh.vertices.push_back({{0, std::numeric_limits<float>::quiet_NaN(), 0}, {0, 1, 0}, {0, 0}});
    mesh.vertices.push_back({{std::numeric_limits<float>::infinity(), 0, 0}, {0, 1, 0}, {0, 0}});
    const std::vector<uint32_t> finite = mesh.indices;
    mesh.indices.insert(mesh.indices.begin() + 3, {0, 1, 4, 5, 1, 2});
    const FacetMesh facets = facet_mesh(mesh);
    EXPECT_EQ(triangles_of(facets.indices, [&](uint32_t i) { return facets.vertices[i].vertex.position; }),
              triangles_of(finite, [&](uint32_t i) { return mesh.vertices[i].position; }));
    EXPECT_TRUE(facet_mesh(Mesh{}).indices.empty());
}

}  // namespace
}  // namespace stairstep
