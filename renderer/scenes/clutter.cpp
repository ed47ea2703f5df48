// Two thousand boxes of all sizes and orientations, lying about or floating: casters and receivers at all distances.
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "renderer/scenes/mesh_shapes.h"
#include "renderer/scenes/scenes.h"
#include "renderer/scenes/staging.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

constexpr int kBoxes = 2000;
/// Each tenth box floats, and of these each second moves.
constexpr int kFloating = 10;
constexpr double kReach = 32;

/// A rotation, uniform over all (Shoemake 1992).
glm::dmat3 random_rotation(Random& random) {
    const double u = random.uniform();
    const double a = 2 * std::numbers::pi * random.uniform();
    const double b = 2 * std::numbers::pi * random.uniform();
    const double low = std::sqrt(1 - u);
    const double high = std::sqrt(u);
    return glm::mat3_cast(glm::dquat(high * std::cos(b), low * std::sin(a), low * std::cos(a), high * std::sin(b)));
}

/// Half the height that a box has once it is rotated.
double half_height(const glm::dmat3& rotation, const glm::dvec3& half_size) {
    return glm::dot(half_size, glm::abs(glm::dvec3(rotation[0].y, rotation[1].y, rotation[2].y)));
}

std::vector<glm::dmat4> movers_at(double t) {
    return {rotate_about({0, 6, 0}, glm::normalize(glm::dvec3(0.12, 1, 0.05)), 80 * t)};
}

AnimatedScene make_clutter() {
    constexpr std::array<glm::vec3, 6> kColours{{{0.66f, 0.26f, 0.14f},
                                                 {0.75f, 0.60f, 0.32f},
                                                 {0.16f, 0.34f, 0.40f},
                                                 {0.62f, 0.62f, 0.58f},
                                                 {0.36f, 0.42f, 0.20f},
                                                 {0.28f, 0.22f, 0.30f}}};
    AnimatedScene animated;
    animated.name = "clutter";
    Scene& scene = animated.scene;
    // A mesh a colour for what rests, and after these one a colour for what moves.
    for (const glm::vec3& colour : kColours) add_part(scene, colour, {});
    for (const glm::vec3& colour : kColours) add_part(scene, colour, {}, 0);
    Random random(1);
    for (int i = 0; i < kBoxes; ++i) {
        const double size = 0.17 * std::exp(1.5 * random.uniform());
        const glm::dvec3 half_size =
            size * glm::dvec3(0.4 + random.uniform(), 0.4 + random.uniform(), 0.4 + random.uniform());
        const glm::dmat3 rotation = random_rotation(random);
        const double distance = kReach * std::sqrt(random.uniform());
        const double around = 2 * std::numbers::pi * random.uniform();
        const bool floats = i % kFloating == 0;
        const bool moves = i % (2 * kFloating) == 0;
        const double clearance = floats ? 3 + 5 * random.uniform() : 0;
        glm::dmat4 place(rotation);
        place[3] = glm::dvec4(distance * std::sin(around), half_height(rotation, half_size) + clearance,
                              distance * std::cos(around), 1);
        const size_t colour = random.below(kColours.size());
        append_box(scene.meshes[moves ? kColours.size() + colour : colour], half_size, place);
    }
    add_floor(scene, 0, 300, {0.56f, 0.54f, 0.50f});

    Walk walk;
    walk.target = {0, 1, 2};
    walk.eye = {11, 19, 38};
    walk.turn_deg = 40;
    walk.approach = 0.65;
    walk.vertical_fov_deg = 40;
    walk.near = 2;
    walk.far = 400;
    animated.state = staged({walking_camera(walk), orbiting_light({-60, 45}, 100, 8, 0.03), movers_at});
    animated.radius = 0.4;
    return animated;
}

}  // namespace

SceneEntry clutter_scene() {
    return {"clutter", "2,000 boxes of all sizes and orientations, some of which float", make_clutter};
}

}  // namespace stairstep
