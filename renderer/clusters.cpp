#include "renderer/clusters.h"

#include <algorithm>
#include <array>

namespace stairstep {
namespace {

struct Triangle {
    std::array<uint32_t, 3> indices;
    glm::vec3 middle;
};

Bounds bounds_of(std::span<const Triangle> triangles, const std::vector<FacetVertex>& vertices) {
    Bounds bounds;
    for (const Triangle& triangle : triangles) {
        for (const uint32_t index : triangle.indices) bounds.add(vertices[index].vertex.position);
    }
    return bounds;
}

void split(std::span<Triangle> triangles, const FacetMesh& mesh, size_t first, std::vector<Cluster>& clusters) {
    if (triangles.size() <= kClusterTriangles) {
        clusters.push_back({3 * first, 3 * triangles.size(), bounds_of(triangles, mesh.vertices)});
        return;
    }
    Bounds middles;
    for (const Triangle& triangle : triangles) middles.add(triangle.middle);
    const glm::dvec3 side = middles.high - middles.low;
    const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    const size_t half = triangles.size() / 2;
    std::nth_element(triangles.begin(), triangles.begin() + half, triangles.end(),
                     [axis](const Triangle& a, const Triangle& b) { return a.middle[axis] < b.middle[axis]; });
    split(triangles.first(half), mesh, first, clusters);
    split(triangles.subspan(half), mesh, first + half, clusters);
}

/// How far the box reaches beyond a plane, on its inner side.
double reach_beyond(const Bounds& bounds, const glm::dvec4& plane) {
    const glm::dvec3 normal(plane);
    const glm::dvec3 farthest(normal.x > 0 ? bounds.high.x : bounds.low.x, normal.y > 0 ? bounds.high.y : bounds.low.y,
                              normal.z > 0 ? bounds.high.z : bounds.low.z);
    return glm::dot(normal, farthest) + plane.w;
}

bool is_within(const Bounds& bounds, std::span<const glm::dvec4> planes) {
    return std::none_of(planes.begin(), planes.end(),
                        [&](const glm::dvec4& plane) { return reach_beyond(bounds, plane) < 0; });
}

void append(std::vector<IndexRun>& runs, const Cluster& cluster) {
    if (!runs.empty() && runs.back().first_index + runs.back().index_count == cluster.first_index) {
        runs.back().index_count += cluster.index_count;
    } else {
        runs.push_back({cluster.first_index, cluster.index_count});
    }
}

}  // namespace

std::vector<Cluster> make_clusters(FacetMesh& mesh) {
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.indices.size() / 3);
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::array corners{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        glm::vec3 middle(0);
        for (const uint32_t corner : corners) middle += mesh.vertices[corner].vertex.position / 3.0f;
        triangles.push_back({corners, middle});
    }
    std::vector<Cluster> clusters;
    if (!triangles.empty()) split(triangles, mesh, 0, clusters);
    mesh.indices.clear();
    for (const Triangle& triangle : triangles) {
        mesh.indices.insert(mesh.indices.end(), triangle.indices.begin(), triangle.indices.end());
    }
    return clusters;
}

std::vector<IndexRun> runs_within(std::span<const Cluster> clusters, std::span<const glm::dvec4> planes) {
    std::vector<IndexRun> runs;
    for (const Cluster& cluster : clusters) {
        if (is_within(cluster.bounds, planes)) append(runs, cluster);
    }
    return runs;
}

OrderedRuns runs_from(const glm::dvec4& front, std::span<const Cluster> clusters, std::span<const glm::dvec4> planes) {
    std::vector<std::pair<double, const Cluster*>> reaches;
    for (const Cluster& cluster : clusters) {
        if (is_within(cluster.bounds, planes)) reaches.emplace_back(reach_beyond(cluster.bounds, front), &cluster);
    }
    // Clusters lie in the order of their addresses, so that none changes places with another that is as far.
    std::sort(reaches.begin(), reaches.end());
    OrderedRuns ordered;
    for (const auto& [reach, cluster] : reaches) append(ordered.runs, *cluster);
    if (!reaches.empty()) ordered.farthest = reaches.back().first;
    return ordered;
}

}  // namespace stairstep
