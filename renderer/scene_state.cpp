#include "renderer/scene_state.h"

namespace stairstep {

Bounds caster_bounds(const Scene& scene, const SceneState& state) {
    Bounds bounds;
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.casts) continue;
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            if (!is_finite_triangle(mesh, i)) continue;
            for (size_t corner = i; corner < i + 3; ++corner) {
                const glm::dvec3 position = mesh.vertices[mesh.indices[corner]].position;
                bounds.add(mesh.mover ? glm::dvec3(state.movers[*mesh.mover] * glm::dvec4(position, 1)) : position);
            }
        }
    }
    return bounds;
}

}  // namespace stairstep
