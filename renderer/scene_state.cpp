#include "renderer/scene_state.h"

namespace stairstep {

Bounds caster_bounds(const Scene& scene, const SceneState& state) {
    Bounds bounds;
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.casts) continue;
        for (const uint32_t index : mesh.indices) {
            const glm::dvec3 position = mesh.vertices[index].position;
            bounds.add(mesh.mover ? glm::dvec3(state.movers[*mesh.mover] * glm::dvec4(position, 1)) : position);
        }
    }
    return bounds;
}

}  // namespace stairstep
