// Triangles in clusters, so that what lies outside a volume needn't be drawn.
//
// A mesh's triangles are halved along the longest side of their middles' bounds until few are left, and lie in the index buffer
// in that order: what is near in space is near in the buffer, and what a volume holds is a few long runs.
#pragma once

#include <span>
#include <vector>

#include "renderer/facet_vertices.h"

namespace stairstep {

/// Most triangles of a cluster: fewer would be culled better, but each test costs about what drawing some triangles does.
inline constexpr size_t kClusterTriangles = 256;

struct Cluster {
    /// In the mesh's indices.
    size_t first_index = 0;
    size_t index_count = 0;
    Bounds bounds;
};

/// Puts the mesh's indices in the order of clusters, each triangle's own staying as they are. Together the clusters are all
/// indices, in their order.
std::vector<Cluster> make_clusters(FacetMesh& mesh);

/// A run of indices.
struct IndexRun {
    size_t first_index = 0;
    size_t index_count = 0;

    bool operator==(const IndexRun&) const = default;
};

/// Runs of the clusters that may hold a point on the inner side of all planes: dot(plane.xyz, p) + plane.w ≥ 0, in the clusters'
/// space. A cluster outside of one plane is left out; without planes all clusters are one run.
std::vector<IndexRun> runs_within(std::span<const Cluster> clusters, std::span<const glm::dvec4> planes);

/// The same in order of how far beyond a plane the clusters reach, nearest first: then most of what is hidden is drawn after what
/// hides it, and what lies under everything, as a ground does, comes last. Each cluster is a run, unless the next one follows it.
struct OrderedRuns {
    std::vector<IndexRun> runs;
    /// How far the last of them reaches beyond the plane, in multiples of its normal's length.
    double farthest = -INFINITY;
};
OrderedRuns runs_from(const glm::dvec4& front, std::span<const Cluster> clusters, std::span<const glm::dvec4> planes);

}  // namespace stairstep
