// How a procedural scene's light, casters and camera move: each by a function of its own, of time in [0, 1].
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene_state.h"

namespace stairstep {

/// What each motion does; the others then stay as at time 0.
struct Staging {
    std::function<Camera(double t)> camera;
    std::function<Light(double t)> light;
    /// Empty where nothing moves.
    std::function<std::vector<glm::dmat4>(double t)> movers;
};

/// AnimatedScene::state of a staging.
std::function<SceneState(Motion motion, double t)> staged(Staging staging);

/// A walk around what is looked at.
struct Walk {
    glm::dvec3 target{0};
    /// Where the eye starts from.
    glm::dvec3 eye{0};
    /// How far it walks around the vertical through the target, degrees.
    double turn_deg = 30;
    /// Its distance from the target at the end, of that at the start, > 0.
    double approach = 0.7;
    double vertical_fov_deg = 35;
    double near = 0.1;
    double far = 1000;
};

std::function<Camera(double t)> walking_camera(const Walk& walk);

/// A sun that goes around by `turn_deg` and rises by `rise_deg`.
std::function<Light(double t)> orbiting_light(const Direction& start, double turn_deg, double rise_deg,
                                              double half_tangent);

/// A square at this height around the origin that receives shadows, casts none and fades; appended with a material of
/// this colour.
void add_floor(Scene& scene, double y, double half_side, const glm::vec3& colour);

/// Appends a mesh with a material of its own, of this colour. The reference holds until the next mesh is appended.
Mesh& add_part(Scene& scene, const glm::vec3& colour, Mesh shape, std::optional<size_t> mover = std::nullopt);

}  // namespace stairstep
