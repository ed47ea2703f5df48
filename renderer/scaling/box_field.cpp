#include "renderer/scaling/box_field.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "renderer/scenes/mesh_shapes.h"
#include "renderer/scenes/staging.h"
#include "stimuli/random.h"

namespace stairstep::scaling {
namespace {

constexpr double kReach = 16;
constexpr int kTrianglesOfBox = 12;
/// Each third box floats.
constexpr int kFloating = 3;

double triangles_of(int cells) {
    return kBoxes * kTrianglesOfBox * static_cast<double>(cells) * cells + 2;
}

}  // namespace

void append_divided_box(Mesh& mesh, const glm::dvec3& half_size, const glm::dmat4& world_from_box, int cells) {
    assert(cells >= 1);
    for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) {
            // u × v points out of the face: along the axis on one side, and swapped on the other.
            const int u = side > 0 ? (axis + 1) % 3 : (axis + 2) % 3;
            const int v = side > 0 ? (axis + 2) % 3 : (axis + 1) % 3;
            glm::dvec3 normal(0);
            normal[axis] = side;
            const glm::vec3 world_normal(glm::dmat3(world_from_box) * normal);
            const auto first = static_cast<uint32_t>(mesh.vertices.size());
            for (int j = 0; j <= cells; ++j) {
                for (int i = 0; i <= cells; ++i) {
                    // By the same arithmetic from whichever face it is reached.
                    glm::dvec3 place;
                    place[axis] = side * half_size[axis];
                    place[u] = (2.0 * i / cells - 1) * half_size[u];
                    place[v] = (2.0 * j / cells - 1) * half_size[v];
                    mesh.vertices.push_back({glm::vec3(world_from_box * glm::dvec4(place, 1)), world_normal, {}});
                }
            }
            const auto row = static_cast<uint32_t>(cells + 1);
            for (uint32_t j = 0; j + 1 < row; ++j) {
                for (uint32_t i = 0; i + 1 < row; ++i) {
                    const uint32_t corner = first + j * row + i;
                    for (const uint32_t step : {0u, 1u, row + 1, 0u, row + 1, row}) {
                        mesh.indices.push_back(corner + step);
                    }
                }
            }
        }
    }
}

int cells_for(double triangles) {
    const int below = std::max(1, static_cast<int>(std::sqrt(triangles / (kBoxes * kTrianglesOfBox))));
    return triangles * triangles > triangles_of(below) * triangles_of(below + 1) ? below + 1 : below;
}

Scene make_box_field(int cells) {
    constexpr std::array<glm::vec3, 4> kColours{
        {{0.66f, 0.26f, 0.14f}, {0.75f, 0.60f, 0.32f}, {0.16f, 0.34f, 0.40f}, {0.62f, 0.62f, 0.58f}}};
    Scene scene;
    for (const glm::vec3& colour : kColours) add_part(scene, colour, {});
    Random random(1);
    for (int i = 0; i < kBoxes; ++i) {
        const double size = 0.45 * std::exp(random.uniform());
        const glm::dvec3 half_size =
            size * glm::dvec3(0.5 + random.uniform(), 0.5 + 1.5 * random.uniform(), 0.5 + random.uniform());
        const double distance = kReach * std::sqrt(random.uniform());
        const double around = 2 * std::numbers::pi * random.uniform();
        const double turn_deg = 90 * random.uniform();
        const double clearance = i % kFloating == 0 ? 0.5 + 3 * random.uniform() : 0;
        glm::dmat4 place = turn_about({0, 0, 0}, turn_deg);
        place[3] = glm::dvec4(distance * std::sin(around), half_size.y + clearance, distance * std::cos(around), 1);
        append_divided_box(scene.meshes[random.below(kColours.size())], half_size, place, cells);
    }
    add_floor(scene, 0, 200, {0.56f, 0.54f, 0.50f});
    return scene;
}

}  // namespace stairstep::scaling
