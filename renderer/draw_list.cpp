#include "renderer/draw_list.h"

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

}  // namespace

DrawList draw_list(const GpuScene& scene, const SceneState& state, std::span<const glm::dvec4> planes, Which which) {
    DrawList list;
    for (size_t i = 0; i < scene.draws.size(); ++i) {
        const GpuScene::Draw& draw = scene.draws[i];
        if (!belongs(draw, which)) continue;
        std::vector<glm::dvec4> planes_model(planes.begin(), planes.end());
        const glm::dmat4 transposed = glm::transpose(world_from_model(draw, state));
        for (glm::dvec4& plane : planes_model) plane = transposed * plane;
        std::vector<IndexRun> runs = runs_within(draw.clusters, planes_model);
        if (!runs.empty()) list.items.push_back({i, std::move(runs)});
    }
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
    for (const IndexRun& run : item.runs) {
        gl::DrawElements(GL_TRIANGLES, static_cast<GLsizei>(run.index_count), GL_UNSIGNED_INT,
                         reinterpret_cast<const void*>((offset + run.first_index) * sizeof(uint32_t)));
    }
}

}  // namespace stairstep
