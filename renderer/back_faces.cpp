#include "renderer/back_faces.h"

#include <cmath>
#include <numbers>

namespace stairstep {

std::vector<glm::dvec3> ray_starts(const Camera& camera, double aspect) {
    const auto& [right, up, back] = camera.basis;
    const glm::dvec3 middle = camera.eye - camera.near * back;
    const double half_height = camera.near * std::tan(camera.vertical_fov_deg * std::numbers::pi / 360);
    const glm::dvec3 y = half_height * up;
    const glm::dvec3 x = half_height * aspect * right;
    return {middle - x - y, middle + x - y, middle - x + y, middle + x + y};
}

std::vector<glm::dvec3> ray_starts(const LightFrustum& frustum) {
    if (frustum.kind == Light::Kind::directional) return {};
    return {frustum.position};
}

void set_faces(const GpuScene::Draw& draw, const SceneState& state, std::span<const glm::dvec3> starts) {
    const glm::dmat4 model_from_world = glm::inverse(world_from_model(draw, state));
    std::vector<glm::dvec3> own;
    for (const glm::dvec3& start : starts) own.emplace_back(model_from_world * glm::dvec4(start, 1));
    if (draw.solids.empty() || may_hold(draw.solids, own)) return set_both_faces();
    gl::Enable(GL_CULL_FACE);
}

void set_both_faces() {
    gl::Disable(GL_CULL_FACE);
}

}  // namespace stairstep
