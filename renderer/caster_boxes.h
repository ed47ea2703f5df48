// Boxes around all of a scene's casters, few enough to look at each: what may throw a shadow at all.
#pragma once

#include <optional>
#include <vector>

#include "renderer/gpu_scene.h"

namespace stairstep {

/// Most boxes of a scene.
inline constexpr size_t kMostCasterBoxes = 128;

struct CasterBox {
    /// In the space that its casters move in.
    Bounds bounds;
    /// As Mesh::mover.
    std::optional<size_t> mover;
};

/// Boxes that together hold all casting triangles, each triangle whole in one: those of clusters, or of several that follow each other
/// and move as one, as few as give no more than kMostCasterBoxes. More only where more than that move on their own. Anchor: 300
/// casters of a triangle each that stand still get 100 boxes.
std::vector<CasterBox> caster_boxes(const GpuScene& scene);

/// A box turned anywhere: all points centre + Σ u_i·half_i·axis_i, |u_i| ≤ 1.
struct TurnedBox {
    glm::dvec3 centre{0};
    /// Unit vectors, perpendicular.
    glm::dmat3 axes{1};
    glm::dvec3 half{0};

    /// How far it reaches to either side of its centre along a direction, in that direction's length.
    double extent(const glm::dvec3& direction) const { return glm::dot(glm::abs(direction * axes), half); }
};

/// Where a box is now, world space.
TurnedBox box_at(const CasterBox& box, const SceneState& state);

}  // namespace stairstep
