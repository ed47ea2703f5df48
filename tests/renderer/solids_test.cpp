#include "renderer/solids.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "stimuli/random.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

/// The outward sides of a box, without the first `missing` of its 12 triangles.
Mesh box_mesh(const glm::vec3& low, const glm::vec3& high, size_t missing = 0) {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool far : {false, true}) {
            const auto first = static_cast<uint32_t>(mesh.vertices.size());
            for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
                glm::vec3 place;
                place[axis] = far ? high[axis] : low[axis];
                place[(axis + 1) % 3] = u ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
                place[(axis + 2) % 3] = v ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
                mesh.vertices.push_back({place, {0, 1, 0}, {0, 0}});
            }
            const uint32_t a = far ? 1 : 3;
            const uint32_t b = far ? 3 : 1;
            mesh.indices.insert(mesh.indices.end(), {first, first + a, first + 2, first, first + 2, first + b});
        }
    }
    mesh.indices.erase(mesh.indices.begin(), mesh.indices.begin() + 3 * missing);
    return mesh;
}

void append(Mesh& mesh, const Mesh& more) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const uint32_t index : more.indices) mesh.indices.push_back(first + index);
}

void turn_inside_out(Mesh& mesh) {
    for (size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i], mesh.indices[i + 1]);
}

size_t triangles_in(const Solids& solids) {
    return std::count(solids.has_triangle.begin(), solids.has_triangle.end(), true);
}

Solids solids_of(const Mesh& mesh) {
    return find_solids(facet_mesh(mesh));
}

TEST(Solids, AreClosedAndFaceOutwards) {
    const Solids box = solids_of(box_mesh({1, 2, 3}, {2, 4, 6}));
    EXPECT_EQ(triangles_in(box), 12u);
    ASSERT_EQ(box.bounds.size(), 1u);
    EXPECT_EQ(box.bounds[0].low, glm::dvec3(1, 2, 3));
    EXPECT_EQ(box.bounds[0].high, glm::dvec3(2, 4, 6));

    Mesh inside_out = box_mesh({1, 2, 3}, {2, 4, 6});
    turn_inside_out(inside_out);
    EXPECT_EQ(triangles_in(solids_of(inside_out)), 0u);
    for (const size_t missing : {1, 2, 6}) {
        EXPECT_EQ(triangles_in(solids_of(box_mesh({1, 2, 3}, {2, 4, 6}, missing))), 0u) << missing;
    }
    EXPECT_EQ(triangles_in(solids_of(made::ground(0, 1))), 0u);
    EXPECT_EQ(triangles_in(solids_of(Mesh{})), 0u);
}

// Its seam has two vertices in each place, and its poles have triangles without area.
TEST(Solids, ASphereIsOneFromASide) {
    Mesh sphere = made::sphere(2, 12);
    const size_t count = sphere.indices.size() / 3;
    const size_t outward = triangles_in(solids_of(sphere));
    turn_inside_out(sphere);
    const size_t inward = triangles_in(solids_of(sphere));
    EXPECT_EQ(std::max(outward, inward), count);
    EXPECT_EQ(std::min(outward, inward), 0u);
}

TEST(Solids, AreToldFromWhatIsOpenInTheSameMesh) {
    Mesh mesh = made::ground(0, 10);
    append(mesh, box_mesh({0, 1, 0}, {1, 2, 1}));
    append(mesh, box_mesh({4, 1, 0}, {5, 2, 1}, 2));
    append(mesh, box_mesh({-4, 1, 0}, {-3, 2, 1}));
    const Solids solids = solids_of(mesh);
    EXPECT_EQ(solids.bounds.size(), 2u);
    std::vector<bool> expected(2, false);
    expected.insert(expected.end(), 12, true);
    expected.insert(expected.end(), 10, false);
    expected.insert(expected.end(), 12, true);
    EXPECT_EQ(solids.has_triangle, expected);
}

// A hollow's walls face what is inside; seen from outside they hide nothing but themselves.
TEST(Solids, AHollowIsNone) {
    Mesh mesh = box_mesh({0, 0, 0}, {4, 4, 4});
    Mesh hollow = box_mesh({1, 1, 1}, {3, 3, 3});
    turn_inside_out(hollow);
    append(mesh, hollow);
    const Solids solids = solids_of(mesh);
    EXPECT_EQ(solids.bounds.size(), 1u);
    EXPECT_EQ(triangles_in(solids), 12u);
}

// Boxes that have a corner or an edge in common are one part, whose edges are still gone along both ways.
TEST(Solids, MayTouch) {
    Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
    append(mesh, box_mesh({1, 1, 0}, {2, 2, 1}));
    append(mesh, box_mesh({2, 2, 1}, {3, 3, 2}));
    EXPECT_EQ(triangles_in(solids_of(mesh)), 36u);
}

TEST(Solids, HoldNoPointThatIsOutsideTheirBoxes) {
    const std::vector<Bounds> solids = solids_of(box_mesh({0, 0, 0}, {1, 1, 1})).bounds;
    const auto holds = [&](const std::vector<glm::dvec3>& points) { return may_hold(solids, points); };
    EXPECT_TRUE(holds({{0.5, 0.5, 0.5}}));
    EXPECT_TRUE(holds({{1, 1, 1}}));
    EXPECT_FALSE(holds({{1.01, 0.5, 0.5}}));
    EXPECT_FALSE(holds({}));
    // Neither end is in it, but what lies between.
    EXPECT_TRUE(holds({{-1, 0.5, 0.5}, {2, 0.5, 0.5}}));
    EXPECT_FALSE(may_hold({}, std::vector<glm::dvec3>{{0, 0, 0}}));
}

}  // namespace
}  // namespace stairstep
