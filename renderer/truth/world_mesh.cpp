#include "renderer/truth/world_mesh.h"

namespace stairstep {

std::vector<WorldMesh> world_meshes(const Scene& scene, const SceneState& state) {
    std::vector<WorldMesh> meshes;
    for (const Mesh& mesh : scene.meshes) {
        WorldMesh world{{}, {}, mesh.casts};
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            if (is_finite_triangle(mesh, i)) {
                world.indices.insert(world.indices.end(), mesh.indices.begin() + i, mesh.indices.begin() + i + 3);
            }
        }
        world.positions.reserve(mesh.vertices.size());
        for (const Vertex& vertex : mesh.vertices) {
            world.positions.push_back(
                mesh.mover ? glm::vec3(state.movers[*mesh.mover] * glm::dvec4(glm::dvec3(vertex.position), 1))
                           : vertex.position);
        }
        meshes.push_back(std::move(world));
    }
    return meshes;
}

}  // namespace stairstep
