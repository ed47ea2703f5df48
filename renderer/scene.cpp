#include "renderer/scene.h"

#include <cmath>

namespace stairstep {

bool is_finite_triangle(const Mesh& mesh, size_t first_index) {
    for (size_t i = first_index; i < first_index + 3; ++i) {
        const glm::vec3& corner = mesh.vertices[mesh.indices[i]].position;
        if (!(std::isfinite(corner.x) && std::isfinite(corner.y) && std::isfinite(corner.z))) return false;
    }
    return true;
}

Bounds caster_bounds(const Scene& scene) {
    Bounds bounds;
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.casts) continue;
        // By index, as a vertex that no triangle uses is not seen.
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            if (!is_finite_triangle(mesh, i)) continue;
            for (size_t corner = i; corner < i + 3; ++corner) bounds.add(mesh.vertices[mesh.indices[corner]].position);
        }
    }
    return bounds;
}

size_t triangle_count(const Scene& scene) {
    size_t count = 0;
    for (const Mesh& mesh : scene.meshes) count += mesh.indices.size() / 3;
    return count;
}

void add_ground(Scene& scene, double reach) {
    const Bounds casters = caster_bounds(scene);
    const glm::dvec3 centre = casters.centre();
    const double half_side = reach * casters.diagonal();
    const auto corner = [&](double x, double z) {
        return Vertex{glm::vec3(centre.x + x * half_side, casters.low.y, centre.z + z * half_side), {0, 1, 0}, {0, 0}};
    };
    Mesh ground;
    ground.vertices = {corner(-1, -1), corner(-1, 1), corner(1, 1), corner(1, -1)};
    ground.indices = {0, 1, 2, 0, 2, 3};
    ground.material = scene.materials.size();
    ground.casts = false;
    ground.fades = true;
    scene.materials.push_back({glm::vec3(0.52f, 0.50f, 0.47f), std::nullopt});
    scene.meshes.push_back(std::move(ground));
}

}  // namespace stairstep
