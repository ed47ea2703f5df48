#include "renderer/caster_boxes.h"

#include <algorithm>

namespace stairstep {
namespace {

/// So many that follow each other become one, if they move as one.
std::vector<CasterBox> joined_by(const std::vector<CasterBox>& boxes, size_t each) {
    std::vector<CasterBox> joined;
    size_t in_last = each;
    for (const CasterBox& box : boxes) {
        if (in_last == each || joined.back().mover != box.mover) {
            joined.push_back({{}, box.mover});
            in_last = 0;
        }
        joined.back().bounds.add(box.bounds.low);
        joined.back().bounds.add(box.bounds.high);
        ++in_last;
    }
    return joined;
}

}  // namespace

std::vector<CasterBox> caster_boxes(const GpuScene& scene) {
    std::vector<CasterBox> boxes;
    for (const GpuScene::Draw& draw : scene.draws) {
        if (!draw.casts) continue;
        for (const Cluster& cluster : draw.clusters) boxes.push_back({cluster.bounds, draw.mover});
    }
    std::stable_sort(boxes.begin(), boxes.end(),
                     [](const CasterBox& a, const CasterBox& b) { return a.mover < b.mover; });
    size_t each = std::max<size_t>((boxes.size() + kMostCasterBoxes - 1) / kMostCasterBoxes, 1);
    std::vector<CasterBox> joined = joined_by(boxes, each);
    while (joined.size() > kMostCasterBoxes && each < boxes.size()) joined = joined_by(boxes, each *= 2);
    return joined;
}

TurnedBox box_at(const CasterBox& box, const SceneState& state) {
    const glm::dmat4 world_from_box = state.placement(box.mover);
    return {glm::dvec3(world_from_box * glm::dvec4(box.bounds.centre(), 1)), glm::dmat3(world_from_box),
            0.5 * (box.bounds.high - box.bounds.low)};
}

}  // namespace stairstep
