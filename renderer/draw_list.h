// What of a scene a pass draws.
#pragma once

#include <span>
#include <vector>

#include "renderer/gpu_scene.h"

namespace stairstep {

/// All, or of those that cast shadows the ones that stand still, or the ones that move.
enum class Which { all, still_casters, moving_casters };

struct DrawList {
    struct Item {
        /// In GpuScene::draws.
        size_t draw = 0;
        std::vector<IndexRun> runs;

        bool operator==(const Item&) const = default;
    };
    std::vector<Item> items;
    /// Whether those of solids (solids.h), which are nowhere the nearest surface, are drawn as well.
    bool back_faces = true;

    bool operator==(const DrawList&) const = default;
};

/// What may lie on the inner side of all planes (world space, as cut_corners has them), by clusters.
DrawList draw_list(const GpuScene& scene, const SceneState& state, std::span<const glm::dvec4> planes, Which which,
                   bool back_faces);

/// All that may, front to back as seen from a plane (clusters.h).
DrawList draw_list_from(const glm::dvec4& front, const GpuScene& scene, const SceneState& state,
                        std::span<const glm::dvec4> planes, bool back_faces);

size_t triangle_count(const DrawList& list);

/// Draws the triangles of an item with what is bound.
void draw_runs(const GpuScene& scene, const DrawList::Item& item);

}  // namespace stairstep
