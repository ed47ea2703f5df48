#include "renderer/scenes/staging.h"

#include <cmath>

#include "renderer/scenes/mesh_shapes.h"

namespace stairstep {

std::function<SceneState(Motion motion, double t)> staged(Staging staging) {
    return [staging = std::move(staging)](Motion motion, double t) {
        const auto time_of = [&](Motion own) { return motion == own ? t : 0; };
        SceneState state;
        state.camera = staging.camera(time_of(Motion::camera));
        state.light = staging.light(time_of(Motion::light));
        if (staging.movers) state.movers = staging.movers(time_of(Motion::caster));
        return state;
    };
}

std::function<Camera(double t)> walking_camera(const Walk& walk) {
    return [walk](double t) {
        const glm::dvec3 offset(turn_about(glm::dvec3(0), walk.turn_deg * t) * glm::dvec4(walk.eye - walk.target, 1));
        const glm::dvec3 eye = walk.target + offset * std::pow(walk.approach, t);
        return camera_looking_at(eye, walk.target, walk.vertical_fov_deg, walk.near, walk.far);
    };
}

std::function<Light(double t)> orbiting_light(const Direction& start, double turn_deg, double rise_deg,
                                              double half_tangent) {
    return [=](double t) {
        return directional_light({start.azimuth_deg + turn_deg * t, start.elevation_deg + rise_deg * t}, half_tangent);
    };
}

void add_floor(Scene& scene, double y, double half_side, const glm::vec3& colour) {
    Mesh floor;
    append_grid(floor, {-half_side, y, half_side}, {2 * half_side, 0, 0}, {0, 0, -2 * half_side}, 1, 1);
    floor.casts = false;
    floor.fades = true;
    add_part(scene, colour, std::move(floor));
}

Mesh& add_part(Scene& scene, const glm::vec3& colour, Mesh shape, std::optional<size_t> mover) {
    shape.material = scene.materials.size();
    shape.mover = mover;
    scene.materials.push_back({colour, std::nullopt});
    return scene.meshes.emplace_back(std::move(shape));
}

}  // namespace stairstep
