// Seven rooms in a row along a corridor, furnished, with a lamp in each and one in the corridor, seen from within the middle one:
// most lamps shine where nobody looks.
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/scenes/mesh_shapes.h"
#include "renderer/scenes/scenes.h"
#include "renderer/scenes/staging.h"

namespace stairstep {
namespace {

constexpr int kRooms = 7;
/// From the middle of a wall to the next one's, and half of it.
constexpr double kSide = 5;
constexpr double kHalf = kSide / 2;
constexpr double kThickness = 0.12;
/// Walls end below the lamps.
constexpr double kWallHeight = 2.5;
constexpr double kLampHeight = 3.6;
constexpr double kDoorWidth = 1.1;
constexpr double kDoorHeight = 2.1;
constexpr double kCorridor = 1.8;
/// A lamp's light ends on its own room's floor.
constexpr double kConeDeg = 33;
constexpr double kLampHalfSide = 0.05;

/// Of a round vessel: radii over heights.
constexpr std::array<glm::dvec2, 9> kVase{{{0.10, 0.0},
                                           {0.16, 0.06},
                                           {0.20, 0.14},
                                           {0.21, 0.22},
                                           {0.18, 0.32},
                                           {0.11, 0.40},
                                           {0.08, 0.46},
                                           {0.10, 0.52},
                                           {0.13, 0.56}}};

double middle_of(int room) {
    return kSide * (room - (kRooms - 1) / 2);
}

void add_wall(Scene& scene, const glm::dvec3& low, const glm::dvec3& high) {
    append_box(add_part(scene, {0.74f, 0.71f, 0.66f}, {}), low, high);
}

/// The walls that a room has to itself: the one on its left, the one at its back, and the one with the door.
void add_walls(Scene& scene, double x) {
    const double t = kThickness / 2;
    const double side = kHalf - t;
    add_wall(scene, {x - kHalf - t, 0, -side}, {x - kHalf + t, kWallHeight, side});
    add_wall(scene, {x - side, 0, -kHalf - t}, {x + side, kWallHeight, -kHalf + t});
    const double jamb = kDoorWidth / 2;
    add_wall(scene, {x - side, 0, kHalf - t}, {x - jamb, kWallHeight, kHalf + t});
    add_wall(scene, {x + jamb, 0, kHalf - t}, {x + side, kWallHeight, kHalf + t});
    add_wall(scene, {x - jamb, kDoorHeight, kHalf - t}, {x + jamb, kWallHeight, kHalf + t});
}

/// A table with four legs, and two vases on it.
void add_table(Scene& scene, const glm::dmat4& place) {
    Mesh& wood = add_part(scene, {0.46f, 0.28f, 0.14f}, {});
    const auto at = [&](const glm::dvec3& offset) {
        glm::dmat4 moved = place;
        moved[3] = place * glm::dvec4(offset, 1);
        return moved;
    };
    append_box(wood, {0.8, 0.025, 0.45}, at({0, 0.75, 0}));
    for (const double x : {-0.72, 0.72}) {
        for (const double z : {-0.37, 0.37}) append_box(wood, {0.03, 0.36, 0.03}, at({x, 0.363, z}));
    }
    for (const double x : {-0.35, 0.3}) {
        Mesh& vase = add_part(scene, {0.24f, 0.42f, 0.52f}, {});
        append_turned(vase, glm::dvec3(place * glm::dvec4(x, 0.776, 0.1, 1)), kVase, 64);
    }
}

/// Shelves against the wall at the back.
void add_shelves(Scene& scene, double x) {
    Mesh& wood = add_part(scene, {0.58f, 0.44f, 0.28f}, {});
    constexpr double kWidth = 0.9;
    constexpr double kDepth = 0.3;
    const double back = -kHalf + kThickness / 2 + 0.01;
    for (int i = 0; i <= 4; ++i) {
        const double y = 0.45 * i;
        append_box(wood, {x - kWidth, y, back}, {x + kWidth, y + 0.03, back + kDepth});
    }
    for (const double end : {x - kWidth - 0.035, x + kWidth + 0.005}) {
        append_box(wood, {end, 0, back}, {end + 0.03, 1.83, back + kDepth});
    }
}

void add_furniture(Scene& scene, int room) {
    const double x = middle_of(room);
    glm::dmat4 place = turn_about({0, 0, 0}, 25.0 * room - 40);
    place[3] = glm::dvec4(x - 0.3, 0, 0.5, 1);
    add_table(scene, place);
    add_shelves(scene, x + (room % 2 ? 0.5 : -0.5));
    Mesh& stool = add_part(scene, {0.62f, 0.20f, 0.14f}, {});
    append_cylinder(stool, {x + 1.1, 0, 1.2}, {x + 1.1, 0.45, 1.2}, 0.16, 0.22, 48);
}

/// A mobile that hangs in the middle room.
constexpr glm::dvec3 kMobile(0.9, 1.7, 0.3);

std::vector<glm::dmat4> movers_at(double t) {
    return {turn_about(kMobile, 200 * t)};
}

void add_mobile(Scene& scene) {
    Mesh& mobile = add_part(scene, {0.66f, 0.56f, 0.20f}, {}, 0);
    append_beam(mobile, kMobile - glm::dvec3(0.4, 0, 0), kMobile + glm::dvec3(0.4, 0, 0), 0.02);
    append_box(mobile, kMobile + glm::dvec3(0.28, -0.22, -0.1), kMobile + glm::dvec3(0.4, -0.02, 0.1));
    append_box(mobile, kMobile + glm::dvec3(-0.4, -0.3, -0.06), kMobile + glm::dvec3(-0.3, -0.02, 0.06));
}

Light lamp_over(double x, double z, double swing) {
    // Straight down its square would spin.
    return spot_light({x + swing, kLampHeight, z}, {x, 0, z - 0.05}, kLampHalfSide, kConeDeg);
}

AnimatedScene make_rooms() {
    AnimatedScene animated;
    animated.name = "rooms";
    Scene& scene = animated.scene;
    const double end = kRooms * kHalf;
    const double far_wall = kHalf + kCorridor;
    Mesh floor;
    append_grid(floor, {-end, 0, far_wall}, {2 * end, 0, 0}, {0, 0, -far_wall - kHalf}, 1, 1);
    floor.casts = false;
    add_part(scene, {0.52f, 0.48f, 0.42f}, std::move(floor));
    for (int room = 0; room < kRooms; ++room) {
        add_walls(scene, middle_of(room));
        add_furniture(scene, room);
    }
    add_wall(scene, {end - kThickness / 2, 0, -kHalf}, {end + kThickness / 2, kWallHeight, far_wall});
    add_wall(scene, {-end, 0, far_wall}, {end, kWallHeight, far_wall + kThickness});
    add_mobile(scene);

    Walk walk;
    walk.target = {0, 0.9, 0.6};
    walk.eye = {1.7, 2.1, -1.95};
    walk.turn_deg = 35;
    walk.approach = 0.75;
    walk.vertical_fov_deg = 60;
    walk.near = 0.1;
    walk.far = 60;
    const auto lit =
        staged({walking_camera(walk),
                [](double t) { return lamp_over(0, 0, 0.4 * std::sin(2 * std::numbers::pi * t)); }, movers_at});
    animated.state = [lit, corridor = kHalf + kCorridor / 2](Motion motion, double t) {
        SceneState state = lit(motion, t);
        for (int room = 0; room < kRooms; ++room) {
            if (middle_of(room) != 0) state.more_lights.push_back(lamp_over(middle_of(room), 0, 0));
        }
        state.more_lights.push_back(lamp_over(0, corridor, 0));
        return state;
    };
    animated.radius = 0.05;
    return animated;
}

}  // namespace

SceneEntry rooms_scene() {
    return {"rooms", "seven furnished rooms along a corridor, a lamp in each", make_rooms};
}

}  // namespace stairstep
