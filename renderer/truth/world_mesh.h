// The triangles of a scene at a moment, all in world space: what rays are traced through.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene_state.h"

namespace stairstep {

struct WorldMesh {
    std::vector<glm::vec3> positions;
    /// Three a triangle, each below positions.size().
    std::vector<uint32_t> indices;
    bool casts = true;

    size_t triangle_count() const { return indices.size() / 3; }
    std::array<glm::dvec3, 3> triangle(size_t index) const {
        return {positions[indices[3 * index]], positions[indices[3 * index + 1]], positions[indices[3 * index + 2]]};
    }
};

/// The scene's meshes in their order, those that move where the state has them, without triangles that aren't finite (scene.h).
std::vector<WorldMesh> world_meshes(const Scene& scene, const SceneState& state);

}  // namespace stairstep
