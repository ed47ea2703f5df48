// Shapes against closed forms: volume by the divergence theorem, watertightness edge by edge, normals.
#include "renderer/scenes/mesh_shapes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/renderer/scenes/mesh_properties.h"

namespace stairstep {
namespace {

/// A placement that mixes all axes.
glm::dmat4 tilted() {
    return rotate_about({1, 2, 3}, glm::normalize(glm::dvec3(1, -2, 0.5)), 73) * frame_along({4, -1, 2}, {2, 1, -3});
}

double polygon_area(const std::vector<glm::dvec2>& outline) {
    double twice = 0;
    for (size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i];
        const glm::dvec2 b = outline[(i + 1) % outline.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return twice / 2;
}

void expect_solid(const Mesh& mesh, double volume) {
    EXPECT_TRUE(is_watertight(mesh));
    EXPECT_NEAR(volume_of(mesh), volume, 1e-4 * volume);
    expect_unit_outward_normals(mesh);
}

TEST(MeshShapes, ABox) {
    Mesh mesh;
    append_box(mesh, {1, 2, 3}, tilted());
    expect_solid(mesh, 48);
    EXPECT_EQ(mesh.indices.size() / 3, 12u);
    Mesh along_axes;
    append_box(along_axes, {-1, 0, 2}, {3, 1, 7});
    expect_solid(along_axes, 20);
    Bounds bounds;
    for (const Vertex& vertex : along_axes.vertices) bounds.add(vertex.position);
    EXPECT_EQ(bounds.low, glm::dvec3(-1, 0, 2));
    EXPECT_EQ(bounds.high, glm::dvec3(3, 1, 7));
}

TEST(MeshShapes, ABeamRunsFromPointToPointInAnyDirection) {
    for (const glm::dvec3& to :
         {glm::dvec3(0, 5, 0), glm::dvec3(0, -5, 0), glm::dvec3(3, 0, 0), glm::dvec3(-1, 2, 4)}) {
        const glm::dvec3 from(0.5, 1, -2);
        Mesh mesh;
        append_beam(mesh, from, from + to, 0.3);
        expect_solid(mesh, 0.09 * glm::length(to));
        for (const Vertex& vertex : mesh.vertices) {
            const glm::dvec3 offset = glm::dvec3(vertex.position) - from;
            const double along = glm::dot(offset, glm::normalize(to));
            EXPECT_NEAR(std::abs(along - glm::length(to) / 2), glm::length(to) / 2, 1e-5);
            EXPECT_NEAR(glm::length(offset - along * glm::normalize(to)), 0.3 / std::sqrt(2.0), 1e-5);
        }
    }
}

TEST(MeshShapes, CylindersFrustaAndCones) {
    for (const int sides : {3, 4, 8, 24, 100}) {
        // A regular polygon's share of its circle.
        const double area = 0.5 * sides * std::sin(2 * std::numbers::pi / sides);
        for (const glm::dvec2& radii : {glm::dvec2(1, 1), glm::dvec2(2, 0.5), glm::dvec2(0, 1.5), glm::dvec2(1.5, 0)}) {
            Mesh mesh;
            append_cylinder(mesh, {1, 1, 1}, {3, 2, -1}, radii.x, radii.y, sides);
            expect_solid(mesh, area * 3 * (radii.x * radii.x + radii.x * radii.y + radii.y * radii.y) / 3);
        }
    }
}

// With many sides a smooth cylinder's normals are those of the round one.
TEST(MeshShapes, ACylinderIsShadedRound) {
    Mesh mesh;
    append_cylinder(mesh, {0, 0, 0}, {0, 4, 0}, 2, 2, 24);
    int round = 0;
    for (const Vertex& vertex : mesh.vertices) {
        if (std::abs(vertex.normal.y) > 0.5f) continue;
        EXPECT_NEAR(glm::length(vertex.normal - vertex.position * glm::vec3(0.5f, 0, 0.5f)), 0, 1e-5);
        ++round;
    }
    EXPECT_EQ(round, 24 * 4);
}

TEST(MeshShapes, ASweepOfAStarInSections) {
    std::vector<glm::dvec2> star;
    for (int i = 0; i < 14; ++i) {
        const double angle = std::numbers::pi * i / 7;
        star.push_back((i % 2 ? 0.6 : 1.0) * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    const Section sections[] = {{-1, 0}, {0, 1}, {2, 0.7}, {2.5, 1.2}, {4, 0}};
    double volume = 0;
    for (int i = 0; i < 4; ++i) {
        const auto& [z0, s0] = sections[i];
        const auto& [z1, s1] = sections[i + 1];
        volume += polygon_area(star) * (z1 - z0) * (s0 * s0 + s0 * s1 + s1 * s1) / 3;
    }
    Mesh mesh;
    append_sweep(mesh, star, sections, tilted());
    expect_solid(mesh, volume);
}

// A turned sphere converges to 4/3·π·r³.
TEST(MeshShapes, ATurnedSphere) {
    std::vector<glm::dvec2> profile;
    for (int i = 0; i <= 64; ++i) {
        const double angle = std::numbers::pi * i / 64;
        profile.emplace_back(i % 64 ? 2 * std::sin(angle) : 0, 2 - 2 * std::cos(angle));
    }
    Mesh mesh;
    append_turned(mesh, {5, 1, 0}, profile, 128);
    EXPECT_TRUE(is_watertight(mesh));
    EXPECT_NEAR(volume_of(mesh), 4.0 / 3 * std::numbers::pi * 8, 0.1);
    expect_unit_outward_normals(mesh);
}

TEST(MeshShapes, AGridFacesTheSideOfItsCrossProduct) {
    Mesh mesh;
    append_grid(mesh, {1, 2, 3}, {0, 0, 4}, {2, 0, 0}, 5, 3);
    EXPECT_EQ(mesh.indices.size() / 3, 30u);
    expect_unit_outward_normals(mesh);
    EXPECT_NEAR(area_of(mesh), 8, 1e-5);
    for (const Vertex& vertex : mesh.vertices) EXPECT_EQ(vertex.normal, glm::vec3(0, 1, 0));
}

TEST(MeshShapes, ATurnGoesAsAzimuthsDo) {
    const glm::dvec3 turned(turn_about({1, 0, 0}, 90) * glm::dvec4(1, 5, 1, 1));
    EXPECT_NEAR(glm::length(turned - glm::dvec3(2, 5, 0)), 0, 1e-12);
}

}  // namespace
}  // namespace stairstep
