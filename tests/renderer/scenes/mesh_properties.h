// What can be asked of any triangle mesh.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "renderer/scene.h"

namespace stairstep {

inline glm::dvec3 corner_of(const Mesh& mesh, size_t index) {
    return mesh.vertices.at(mesh.indices[index]).position;
}

/// Volume that a closed mesh encloses, positive where its triangles are counter-clockwise from outside: a sixth of the
/// sum of a·(b × c), measured from a vertex of it so that little cancels.
inline double volume_of(const Mesh& mesh) {
    const glm::dvec3 origin = mesh.vertices.at(0).position;
    double sum = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = corner_of(mesh, i) - origin;
        sum += glm::dot(a, glm::cross(corner_of(mesh, i + 1) - origin, corner_of(mesh, i + 2) - origin));
    }
    return sum / 6;
}

inline double area_of(const Mesh& mesh) {
    double sum = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = corner_of(mesh, i);
        sum += glm::length(glm::cross(corner_of(mesh, i + 1) - a, corner_of(mesh, i + 2) - a)) / 2;
    }
    return sum;
}

/// Whether each edge, by the places of its ends, is run along as often in one direction as in the other.
inline bool is_watertight(const Mesh& mesh) {
    using Place = std::tuple<float, float, float>;
    std::map<Place, uint32_t> places;
    std::map<std::pair<uint32_t, uint32_t>, int> balance;
    const auto place_of = [&](size_t index) {
        const glm::vec3& p = mesh.vertices.at(mesh.indices[index]).position;
        return places.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(places.size())).first->second;
    };
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t corners[] = {place_of(i), place_of(i + 1), place_of(i + 2)};
        for (int edge = 0; edge < 3; ++edge) {
            const uint32_t a = corners[edge];
            const uint32_t b = corners[(edge + 1) % 3];
            if (a == b) return false;
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    for (const auto& [edge, sum] : balance) {
        if (sum != 0) return false;
    }
    return true;
}

/// Each normal has length 1 and is on the front side of each triangle that uses it; no triangle is without area.
inline void expect_unit_outward_normals(const Mesh& mesh) {
    for (const Vertex& vertex : mesh.vertices) ASSERT_NEAR(glm::length(vertex.normal), 1, 1e-5);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = corner_of(mesh, i);
        const glm::dvec3 across = glm::cross(corner_of(mesh, i + 1) - a, corner_of(mesh, i + 2) - a);
        ASSERT_GT(glm::length(across), 0) << "triangle " << i / 3;
        for (size_t corner = i; corner < i + 3; ++corner) {
            // Within 60° of the triangle's own.
            const glm::dvec3 normal = mesh.vertices[mesh.indices[corner]].normal;
            ASSERT_GT(glm::dot(normal, glm::normalize(across)), 0.5) << "triangle " << i / 3;
        }
    }
}

}  // namespace stairstep
