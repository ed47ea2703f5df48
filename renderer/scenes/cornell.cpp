// A Cornell box with a tilted plate that floats in it, lit by a square lamp under its ceiling: penumbras of a spot,
// which grow with the distance from the plate on all walls.
#include <cmath>
#include <numbers>

#include "renderer/scenes/mesh_shapes.h"
#include "renderer/scenes/scenes.h"
#include "renderer/scenes/staging.h"

namespace stairstep {
namespace {

/// Half-width and height; the front, at +z, is open.
constexpr double kHalf = 2.75;
constexpr double kHeight = 5.5;
constexpr double kLampHeight = 5.3;
constexpr glm::dvec3 kPlate(0.55, 2.9, -0.1);

void add_wall(Scene& scene, const glm::vec3& colour, const glm::dvec3& corner, const glm::dvec3& u,
              const glm::dvec3& v) {
    Mesh wall;
    append_grid(wall, corner, u, v, 1, 1);
    wall.casts = false;
    add_part(scene, colour, std::move(wall));
}

glm::dmat4 placed(const glm::dmat4& rotation, const glm::dvec3& origin) {
    glm::dmat4 result = rotation;
    result[3] = glm::dvec4(origin, 1);
    return result;
}

std::vector<glm::dmat4> movers_at(double t) {
    glm::dmat4 bobbing(1);
    bobbing[3].y = -0.9 * std::sin(std::numbers::pi * t);
    return {bobbing * turn_about(kPlate, 150 * t)};
}

Light light_at(double t) {
    const double around = 2 * std::numbers::pi * t;
    // Starts in the middle and swings out on a loop. It never points straight down, where its square would spin.
    const glm::dvec3 position(1.2 * std::sin(around), kLampHeight, 1.2 * (1 - std::cos(around)) / 2);
    return spot_light(position, {0.3 * std::sin(around), 0, -0.9}, 0.16, 66);
}

AnimatedScene make_cornell() {
    constexpr glm::vec3 kWhite(0.72f, 0.70f, 0.66f);
    AnimatedScene animated;
    animated.name = "cornell";
    Scene& scene = animated.scene;
    const double side = 2 * kHalf;
    add_wall(scene, kWhite, {-kHalf, 0, kHalf}, {side, 0, 0}, {0, 0, -side});
    add_wall(scene, kWhite, {-kHalf, kHeight, -kHalf}, {side, 0, 0}, {0, 0, side});
    add_wall(scene, kWhite, {-kHalf, 0, -kHalf}, {side, 0, 0}, {0, kHeight, 0});
    add_wall(scene, {0.60f, 0.07f, 0.05f}, {-kHalf, 0, kHalf}, {0, 0, -side}, {0, kHeight, 0});
    add_wall(scene, {0.12f, 0.42f, 0.10f}, {kHalf, 0, -kHalf}, {0, 0, side}, {0, kHeight, 0});

    Mesh& plate = add_part(scene, {0.62f, 0.52f, 0.28f}, {}, 0);
    const glm::dvec3 origin(0);
    append_box(plate, {1.05, 0.05, 0.75},
               placed(rotate_about(origin, {0, 0, 1}, 24) * rotate_about(origin, {1, 0, 0}, 14), kPlate));
    Mesh& block = add_part(scene, kWhite, {});
    append_box(block, {0.8, 0.8, 0.8}, placed(turn_about(origin, 18), {0.9, 0.8, 0.75}));
    append_box(block, {0.78, 1.5, 0.78}, placed(turn_about(origin, -20), {-1.15, 1.5, -1.0}));

    Walk walk;
    walk.target = {0, 2.6, 0};
    walk.eye = {0.3, 2.9, 11.2};
    walk.turn_deg = 16;
    walk.approach = 0.75;
    walk.vertical_fov_deg = 38;
    walk.near = 1;
    walk.far = 40;
    animated.state = staged({walking_camera(walk), light_at, movers_at});
    animated.radius = 0.1;
    return animated;
}

}  // namespace

SceneEntry cornell_scene() {
    return {"cornell", "a Cornell box with a tilted plate, lit by a spot", make_cornell};
}

}  // namespace stairstep
