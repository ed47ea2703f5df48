// A portico of fluted columns before a wall: shadows in contact with what throws them, and penumbras of all sizes up to
// the height of the roof.
#include <cmath>
#include <numbers>

#include "renderer/scenes/mesh_shapes.h"
#include "renderer/scenes/scenes.h"
#include "renderer/scenes/staging.h"

namespace stairstep {
namespace {

constexpr int kColumns = 7;
constexpr double kSpacing = 3.2;
constexpr double kRadius = 0.55;
constexpr double kShaft = 6;
constexpr double kFloor = 1.05;
/// Middles of the first and last columns, and of the two rows.
constexpr double kHalfLength = kSpacing * (kColumns - 1) / 2;
constexpr double kFront = 2;
constexpr double kBack = -2;

/// Twenty flutes, each an arc of six sides, that meet in sharp arrises.
std::vector<glm::dvec2> fluted_outline() {
    constexpr int kFlutes = 20;
    constexpr int kSides = 6;
    std::vector<glm::dvec2> outline;
    for (int i = 0; i < kFlutes * kSides; ++i) {
        const double within = static_cast<double>(i % kSides) / kSides;
        const double angle = 2 * std::numbers::pi * i / (kFlutes * kSides);
        const double radius = 1 - 0.075 * std::sin(std::numbers::pi * within);
        outline.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return outline;
}

void append_column(Mesh& mesh, double x, double z) {
    // Base, fluted shaft with entasis, flaring echinus, square abacus.
    const double foot = kFloor;
    append_box(mesh, {x - 0.75, foot, z - 0.75}, {x + 0.75, foot + 0.18, z + 0.75});
    const glm::dvec2 base[] = {{0.70, 0},    {0.74, 0.08}, {0.70, 0.17}, {0.60, 0.22},
                               {0.60, 0.26}, {0.64, 0.32}, {0.60, 0.38}};
    append_turned(mesh, {x, foot + 0.18, z}, base, 32);
    std::vector<Section> shaft;
    for (int i = 0; i <= 8; ++i) {
        const double h = i / 8.0;
        shaft.push_back({h * kShaft, kRadius * (1 - 0.14 * h * h)});
    }
    append_sweep(mesh, fluted_outline(), shaft, frame_along({x, foot + 0.56, z}, {0, 1, 0}));
    const double neck = foot + 0.56 + kShaft;
    const glm::dvec2 echinus[] = {{0.47, 0}, {0.50, 0.06}, {0.60, 0.16}, {0.72, 0.24}, {0.74, 0.28}};
    append_turned(mesh, {x, neck, z}, echinus, 32);
    append_box(mesh, {x - 0.78, neck + 0.28, z - 0.78}, {x + 0.78, neck + 0.5, z + 0.78});
}

/// Architrave along both rows, cross beams that leave the roof open, a cornice with dentils.
void append_entablature(Mesh& mesh) {
    const double low = kFloor + 0.56 + kShaft + 0.5;
    const double end = kHalfLength + 1;
    for (const double z : {kFront, kBack}) {
        append_box(mesh, {-end, low, z - 0.6}, {end, low + 0.75, z + 0.6});
        append_box(mesh, {-end - 0.12, low + 0.75, z - 0.72}, {end + 0.12, low + 0.95, z + 0.72});
    }
    for (int i = 0; i < 4 * kColumns; ++i) {
        const double x = -end + 0.3 + i * (2 * end - 0.6) / (4 * kColumns - 1);
        append_box(mesh, {x - 0.16, low + 0.95, kBack - 0.9}, {x + 0.16, low + 1.3, kFront + 0.9});
    }
    append_box(mesh, {-end - 0.4, low + 1.3, kFront - 0.3}, {end + 0.4, low + 1.65, kFront + 1.1});
    append_box(mesh, {-end - 0.4, low + 1.3, kBack - 1.1}, {end + 0.4, low + 1.65, kBack + 0.3});
}

/// Three steps around a floor, and a wall with doorways behind.
void append_building(Mesh& stone, Mesh& wall) {
    for (int i = 0; i < 3; ++i) {
        const double out = 2.4 - 0.5 * i;
        append_box(stone, {-kHalfLength - out, 0.35 * i, kBack - 5.2},
                   {kHalfLength + out, 0.35 * (i + 1), kFront + out});
    }
    const double top = kFloor + 0.56 + kShaft + 0.5;
    for (int i = 0; i < 4; ++i) {
        const double pier = 2 * kHalfLength / 4;
        const double x = -kHalfLength + i * pier;
        append_box(wall, {x - (i == 0 ? 1.0 : 0.0), kFloor, kBack - 4.2}, {x + pier - 1.9, top, kBack - 3.4});
        append_box(wall, {x + pier - 1.9, kFloor + 3.6, kBack - 4.2}, {x + pier, top, kBack - 3.4});
    }
    append_box(wall, {kHalfLength, kFloor, kBack - 4.2}, {kHalfLength + 1, top, kBack - 3.4});
}

/// A figure in a robe, 1.8 m high, of turned shapes.
void append_figure(Mesh& robe, Mesh& head, const glm::dvec3& foot) {
    const glm::dvec2 body[] = {{0.30, 0},   {0.31, 0.05}, {0.25, 0.5},  {0.20, 0.95},
                               {0.22, 1.2}, {0.24, 1.38}, {0.17, 1.48}, {0.08, 1.53}};
    append_turned(robe, foot, body, 24);
    std::vector<glm::dvec2> ball;
    for (int i = 0; i <= 10; ++i) {
        const double angle = std::numbers::pi * i / 10;
        ball.emplace_back(i % 10 ? 0.12 * std::sin(angle) : 0, 0.14 * (1 - std::cos(angle)));
    }
    append_turned(head, foot + glm::dvec3(0, 1.52, 0), ball, 24);
}

/// Steady steps along the portico, turning slowly.
std::vector<glm::dmat4> movers_at(double t) {
    glm::dmat4 walk = turn_about(glm::dvec3(0), 60 * t);
    walk[3] =
        glm::dvec4(10 * t, 0.03 * std::sin(10 * std::numbers::pi * t), 0.3 * std::sin(2 * std::numbers::pi * t), 1);
    // The figure is modelled at the origin and stands on the floor where the walk starts.
    walk[3] += glm::dvec4(-kHalfLength + 2.4, kFloor + 0.03, 3.15, 0);
    return {walk};
}

AnimatedScene make_colonnade() {
    AnimatedScene animated;
    animated.name = "colonnade";
    Scene& scene = animated.scene;
    Mesh& columns = add_part(scene, {0.74f, 0.69f, 0.60f}, {});
    for (int i = 0; i < kColumns; ++i) {
        for (const double z : {kFront, kBack}) append_column(columns, -kHalfLength + kSpacing * i, z);
    }
    append_entablature(columns);
    Mesh stone;
    Mesh wall;
    append_building(stone, wall);
    add_part(scene, {0.62f, 0.58f, 0.51f}, std::move(stone));
    add_part(scene, {0.62f, 0.36f, 0.22f}, std::move(wall));
    Mesh robe;
    Mesh head;
    append_figure(robe, head, glm::dvec3(0));
    add_part(scene, {0.50f, 0.10f, 0.09f}, std::move(robe), 0);
    add_part(scene, {0.55f, 0.36f, 0.26f}, std::move(head), 0);
    // A fallen drum and blocks before the steps.
    Mesh& ruins = add_part(scene, {0.70f, 0.66f, 0.58f}, {});
    append_cylinder(ruins, {3.2, 0.55, 6.6}, {5.0, 0.55, 7.3}, 0.55, 0.52, 40);
    append_box(ruins, {0.7, 0.35, 0.45}, [] {
        glm::dmat4 place = turn_about(glm::dvec3(0), 25);
        place[3] = glm::dvec4(-4, 0.35, 6.9, 1);
        return place;
    }());
    add_floor(scene, 0, 250, {0.52f, 0.47f, 0.38f});

    Walk walk;
    walk.target = {-1.2, 3.2, 0};
    walk.eye = {-13, 7.5, 21};
    walk.turn_deg = 45;
    walk.approach = 0.7;
    walk.vertical_fov_deg = 38;
    walk.near = 2;
    walk.far = 300;
    animated.state = staged({walking_camera(walk), orbiting_light({32, 27}, -75, 12, 0.03), movers_at});
    animated.radius = 0.3;
    return animated;
}

}  // namespace

SceneEntry colonnade_scene() {
    return {"colonnade", "fluted columns, steps and a wall: contacts and penumbras of all sizes", make_colonnade};
}

}  // namespace stairstep
