// A lattice tower crane over a building site: gaps finer than any filter beside beams as wide as a penumbra (Kreuzer
// 2017, figure 6.1).
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/scenes/mesh_shapes.h"
#include "renderer/scenes/scenes.h"
#include "renderer/scenes/staging.h"

namespace stairstep {
namespace {

/// The mast stands on the origin; what slews turns about its axis.
constexpr double kMastHeight = 24;
constexpr double kMastHalf = 1.1;
constexpr double kPanel = 2;
constexpr double kJibReach = 24;
constexpr double kCounterReach = 10;
constexpr double kJibHalf = 1.1;
constexpr double kTrolleyReach = 15;
constexpr double kRope = 11;
constexpr double kChord = 0.2;
constexpr double kBrace = 0.1;

enum Mover : size_t { kSlewing, kLoad };

/// The mast: four legs, a frame and crossed diagonals on each side of each panel.
void append_mast(Mesh& mesh) {
    const auto corner = [](int i, double y) {
        return glm::dvec3(i == 0 || i == 3 ? -kMastHalf : kMastHalf, y, i < 2 ? -kMastHalf : kMastHalf);
    };
    for (int side = 0; side < 4; ++side) {
        const int next = (side + 1) % 4;
        append_beam(mesh, corner(side, 0), corner(side, kMastHeight), kChord);
        for (double y = 0; y < kMastHeight - 0.01; y += kPanel) {
            append_beam(mesh, corner(side, y + kPanel), corner(next, y + kPanel), kBrace);
            append_beam(mesh, corner(side, y), corner(next, y + kPanel), kBrace);
            append_beam(mesh, corner(next, y), corner(side, y + kPanel), kBrace);
        }
    }
}

/// The jib along +x: two chords below, one above, zigzags between them.
void append_jib(Mesh& mesh) {
    const double low = kMastHeight + 1.2;
    const double high = low + 2;
    const int panels = static_cast<int>(std::lround(kJibReach / kPanel));
    const auto bottom = [&](int i, double side) { return glm::dvec3(i * kPanel, low, side * kJibHalf); };
    const auto top = [&](int i) { return glm::dvec3((i + 0.5) * kPanel, high, 0); };
    append_beam(mesh, bottom(0, -1), bottom(panels, -1), kChord);
    append_beam(mesh, bottom(0, 1), bottom(panels, 1), kChord);
    append_beam(mesh, top(0), top(panels - 1), kChord);
    for (int i = 0; i < panels; ++i) {
        append_beam(mesh, bottom(i + 1, -1), bottom(i + 1, 1), kBrace);
        append_beam(mesh, bottom(i, i % 2 ? 1 : -1), bottom(i + 1, i % 2 ? -1 : 1), kBrace);
        for (const double side : {-1.0, 1.0}) {
            append_beam(mesh, bottom(i, side), top(i), kBrace);
            append_beam(mesh, top(i), bottom(i + 1, side), kBrace);
        }
    }
    // The trolley that the load hangs from.
    append_box(mesh, {kTrolleyReach - 0.7, low - 0.35, -1.2}, {kTrolleyReach + 0.7, low - 0.12, 1.2});
}

/// The counter-jib along −x, a railed walkway of crossed beams.
void append_counter_jib(Mesh& mesh) {
    const double low = kMastHeight + 1.2;
    const int panels = static_cast<int>(std::lround(kCounterReach / kPanel));
    for (const double side : {-0.8, 0.8}) {
        append_beam(mesh, {0, low, side}, {-kCounterReach, low, side}, 1.5 * kChord);
        append_beam(mesh, {0, low + 1.1, side}, {-kCounterReach, low + 1.1, side}, kBrace);
        for (int i = 0; i <= panels; ++i) {
            append_beam(mesh, {-i * kPanel, low, side}, {-i * kPanel, low + 1.1, side}, kBrace);
        }
    }
    for (int i = 0; i < panels; ++i) {
        append_beam(mesh, {-i * kPanel, low, -0.8}, {-(i + 1) * kPanel, low, 0.8}, kBrace);
        append_beam(mesh, {-i * kPanel, low, 0.8}, {-(i + 1) * kPanel, low, -0.8}, kBrace);
    }
}

/// The tower's tip, and the cables that hold both jibs from it.
void append_tip_and_cables(Mesh& mesh) {
    const double low = kMastHeight + 1.2;
    const glm::dvec3 tip(0, low + 5.5, 0);
    for (const double x : {-0.8, 0.8}) {
        for (const double z : {-0.8, 0.8}) append_beam(mesh, {x, low, z}, tip, kChord);
    }
    for (int i = 1; i < 4; ++i) {
        const double half = 0.8 * (1 - i / 4.0);
        const double y = low + 5.5 * i / 4.0;
        const std::array<glm::dvec3, 4> ring{{{-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half}}};
        for (int side = 0; side < 4; ++side) append_beam(mesh, ring[side], ring[(side + 1) % 4], kBrace);
    }
    for (const double reach : {0.45 * kJibReach, 0.9 * kJibReach}) {
        append_cylinder(mesh, tip, {reach, low + 2, 0}, 0.035, 0.035, 6);
    }
    for (const double side : {-0.8, 0.8}) {
        append_cylinder(mesh, tip, {-kCounterReach + 0.4, low, side}, 0.035, 0.035, 6);
    }
}

/// Ropes, the hook and a bundle of pipes in two slings.
void append_load(Mesh& steel, Mesh& pipes) {
    const double top = kMastHeight + 0.9;
    const double hook = top - kRope;
    for (const double x : {-0.35, 0.35}) {
        for (const double z : {-0.25, 0.25}) {
            append_cylinder(steel, {kTrolleyReach + x, hook, z}, {kTrolleyReach + x, top, z}, 0.03, 0.03, 6);
        }
    }
    append_box(steel, {kTrolleyReach - 0.45, hook - 0.5, -0.35}, {kTrolleyReach + 0.45, hook, 0.35});
    // The hook is three quarters of a ring.
    const glm::dvec3 middle(kTrolleyReach, hook - 0.95, 0);
    const auto around = [&](int i) {
        const double angle = std::numbers::pi * (0.5 - i / 8.0);
        return middle + 0.4 * glm::dvec3(std::cos(angle), std::sin(angle), 0);
    };
    for (int i = 0; i < 12; ++i) append_cylinder(steel, around(i), around(i + 1), 0.07, 0.07, 8);
    const double bundle = hook - 3.2;
    for (const double z : {-1.8, 1.8}) {
        for (const double x : {-0.55, 0.55}) {
            append_cylinder(steel, {kTrolleyReach, hook - 1.35, 0}, {kTrolleyReach + x, bundle, z}, 0.03, 0.03, 6);
        }
    }
    for (int row = 0; row < 3; ++row) {
        for (int i = 0; i < 4 - row; ++i) {
            const double x = kTrolleyReach + 0.32 * (i - (3 - row) / 2.0);
            const double y = bundle - 0.5 + 0.28 * row;
            append_cylinder(pipes, {x, y, -3}, {x, y, 3}, 0.16, 0.16, 14);
        }
    }
}

/// What stands on the site and catches the lattice's shadow: containers, slabs in a stack, a wall being built.
void append_site(Scene& scene) {
    Mesh& concrete = add_part(scene, {0.46f, 0.45f, 0.43f}, {});
    append_box(concrete, {-2.6, 0, -2.6}, {2.6, 0.7, 2.6});
    for (int i = 0; i < 5; ++i) append_box(concrete, {8, 0.05 + 0.4 * i, -9.5}, {13, 0.3 + 0.4 * i, -7});
    append_box(concrete, {-1, 0, -14}, {6, 3.2, -13.6});
    append_box(concrete, {6, 0, -14}, {6.4, 3.2, -10});
    for (int i = 0; i < 5; ++i) {
        append_box(concrete, {-0.5 + 1.5 * i, 3.2, -14}, {-0.1 + 1.5 * i, 4.4, -13.6});
    }
    for (const double x : {-5.0, 5.0}) {
        Mesh& container = add_part(scene, x < 0 ? glm::vec3(0.10f, 0.24f, 0.42f) : glm::vec3(0.45f, 0.13f, 0.08f), {});
        const glm::dmat4 place = turn_about({x, 0, 9}, x < 0 ? 12 : -25);
        const auto part = [&](const glm::dvec3& middle, const glm::dvec3& half) {
            glm::dmat4 there = place;
            there[3] = place * glm::dvec4(x + middle.x, middle.y, 9 + middle.z, 1);
            append_box(container, half, there);
        };
        part({0, 1.3, 0}, {3, 1.25, 1.2});
        for (int i = 0; i < 15; ++i) {
            for (const double side : {-1.23, 1.23}) part({-2.8 + 0.4 * i, 1.3, side}, {0.1, 1.15, 0.04});
        }
    }
}

std::vector<glm::dmat4> movers_at(double t) {
    // Half a smooth swing: the load hangs straight at the start and where it turns back.
    const double swing_deg = 10 * std::sin(2 * std::numbers::pi * t);
    const glm::dmat4 slewing = turn_about(glm::dvec3(0), 70 * t);
    const glm::dvec3 trolley(kTrolleyReach, kMastHeight + 0.9, 0);
    return {slewing, slewing * rotate_about(trolley, {1, 0, 0}, swing_deg)};
}

AnimatedScene make_crane() {
    AnimatedScene animated;
    animated.name = "crane";
    Scene& scene = animated.scene;
    append_mast(add_part(scene, {0.80f, 0.50f, 0.05f}, {}));
    Mesh& jibs = add_part(scene, {0.80f, 0.50f, 0.05f}, {}, kSlewing);
    append_jib(jibs);
    append_counter_jib(jibs);
    append_tip_and_cables(jibs);
    Mesh& ballast = add_part(scene, {0.40f, 0.40f, 0.39f}, {}, kSlewing);
    for (int i = 0; i < 4; ++i) {
        append_box(ballast, {-kCounterReach + 0.55 * i, kMastHeight - 0.6, -0.7},
                   {-kCounterReach + 0.45 + 0.55 * i, kMastHeight + 1.5, 0.7});
    }
    Mesh& cabin = add_part(scene, {0.75f, 0.76f, 0.74f}, {}, kSlewing);
    append_cylinder(cabin, {0, kMastHeight, 0}, {0, kMastHeight + 1.1, 0}, 1.2, 1.2, 32);
    append_box(cabin, {1.2, kMastHeight - 1.2, 0.9}, {2.8, kMastHeight + 0.9, 2.3});
    Mesh steel;
    Mesh pipes;
    append_load(steel, pipes);
    add_part(scene, {0.12f, 0.12f, 0.13f}, std::move(steel), kLoad);
    add_part(scene, {0.30f, 0.36f, 0.40f}, std::move(pipes), kLoad);
    append_site(scene);
    add_floor(scene, 0, 400, {0.50f, 0.45f, 0.38f});

    Walk walk;
    walk.target = {5.5, 12.3, 3};
    walk.eye = {21, 28, 62};
    walk.turn_deg = 35;
    walk.approach = 0.75;
    walk.vertical_fov_deg = 35;
    walk.near = 5;
    walk.far = 500;
    animated.state = staged({walking_camera(walk), orbiting_light({158, 54}, -70, 6, 0.02), movers_at});
    animated.radius = 0.5;
    return animated;
}

}  // namespace

SceneEntry crane_scene() {
    return {"crane", "a lattice tower crane: fine gaps", make_crane};
}

}  // namespace stairstep
