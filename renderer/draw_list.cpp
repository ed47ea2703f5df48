#include "renderer/draw_list.h"

#include <algorithm>

namespace stairstep {
namespace {

bool belongs(const GpuScene::Draw& draw, Which which) {
    switch (which) {
        case Which::all: return true;
        case Which::still_casters: return draw.casts && !draw.mover;
        case Which::moving_casters: break;
    }
    return draw.casts && draw.mover;
}

/// In the draw's model space.
std::vector<glm::dvec4> model_planes(const GpuScene::Draw& draw, const SceneState& state,
                                     std::span<const glm::dvec4> planes) {
    std::vector<glm::dvec4> own(planes.begin(), planes.end());
    const glm::dmat4 transposed = glm::transpose(world_from_model(draw, state));
    for (glm::dvec4& plane : own) plane = transposed * plane;
    return own;
}

}  // namespace

DrawList draw_list(const GpuScene& scene, const SceneState& state, std::span<const glm::dvec4> planes, Which which,
                   bool back_faces) {
    DrawList list{{}, back_faces};
    for (size_t i = 0; i < scene.draws.size(); ++i) {
        const GpuScene::Draw& draw = scene.draws[i];
        if (!belongs(draw, which)) continue;
        std::vector<IndexRun> runs = runs_within(draw.clusters, model_planes(draw, state, planes));
        if (!runs.empty()) list.items.push_back({i, std::move(runs)});
    }
    return list;
}

DrawList draw_list_from(const glm::dvec4& front, const GpuScene& scene, const SceneState& state,
                        std::span<const glm::dvec4> planes, bool back_faces) {
    std::vector<std::pair<double, DrawList::Item>> reaches;
    for (size_t i = 0; i < scene.draws.size(); ++i) {
        const GpuScene::Draw& draw = scene.draws[i];
        const glm::dvec4 own_front = model_planes(draw, state, {&front, 1}).front();
        OrderedRuns ordered = runs_from(own_front, draw.clusters, model_planes(draw, state, planes));
        if (!ordered.runs.empty()) {
            reaches.emplace_back(ordered.farthest, DrawList::Item{i, std::move(ordered.runs)});
        }
    }
    std::stable_sort(reaches.begin(), reaches.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    DrawList list{{}, back_faces};
    for (auto& [reach, item] : reaches) list.items.push_back(std::move(item));
    return list;
}

size_t triangle_count(const DrawList& list) {
    size_t indices = 0;
    for (const DrawList::Item& item : list.items) {
        for (const IndexRun& run : item.runs) indices += run.index_count;
    }
    return indices / 3;
}

void draw_runs(const GpuScene& scene, const DrawList::Item& item) {
    const size_t offset = scene.draws[item.draw].first_index;
    std::vector<GLsizei> counts;
    std::vector<const void*> firsts;
    for (const IndexRun& run : item.runs) {
        counts.push_back(static_cast<GLsizei>(run.index_count));
        firsts.push_back(reinterpret_cast<const void*>((offset + run.first_index) * sizeof(uint32_t)));
    }
    gl::MultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, firsts.data(),
                          static_cast<GLsizei>(counts.size()));
}

}  // namespace stairstep
