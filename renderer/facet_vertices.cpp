#include "renderer/facet_vertices.h"

#include <array>

namespace stairstep {
namespace {

glm::vec3 facet_normal(const std::array<uint32_t, 3>& triangle, const std::vector<Vertex>& vertices) {
    const glm::dvec3 a = vertices[triangle[0]].position;
    const glm::dvec3 b = vertices[triangle[1]].position;
    const glm::dvec3 c = vertices[triangle[2]].position;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    return length > 0 ? glm::vec3(normal / length) : glm::vec3(0);
}

}  // namespace

FacetMesh facet_mesh(const Mesh& mesh) {
    FacetMesh result;
    result.indices.reserve(mesh.indices.size());
    for (const Vertex& vertex : mesh.vertices) result.vertices.push_back({vertex});
    std::vector<bool> taken(mesh.vertices.size(), false);
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        if (!is_finite_triangle(mesh, i)) continue;
        const std::array triangle{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        const glm::vec3 facet = facet_normal(triangle, mesh.vertices);
        const auto fits = [&](uint32_t vertex) { return !taken[vertex] || result.vertices[vertex].facet == facet; };
        size_t last = 2;
        for (size_t corner = 0; corner < 3; ++corner) {
            if (fits(triangle[corner])) last = corner;
        }
        uint32_t end = triangle[last];
        if (!fits(end)) {
            end = static_cast<uint32_t>(result.vertices.size());
            result.vertices.push_back({mesh.vertices[triangle[last]]});
            taken.push_back(true);
        }
        taken[end] = true;
        result.vertices[end].facet = facet;
        result.indices.insert(result.indices.end(), {triangle[(last + 1) % 3], triangle[(last + 2) % 3], end});
    }
    return result;
}

}  // namespace stairstep
