#include "renderer/shadow_map_keeper.h"

namespace stairstep {

bool ShadowMapKeeper::Content::same_as(const Content& other) const {
    return scene == other.scene && shape.texels_equal(other.shape) && casters == other.casters &&
           movers == other.movers;
}

void ShadowMapKeeper::copy_still_casters(const ShadowMap& map) const {
    gl::CopyImageSubData(still_memory_.depth.id(), GL_TEXTURE_2D, 0, 0, 0, 0, map.memory.depth.id(), GL_TEXTURE_2D, 0,
                         0, 0, 0, map.shape.width + 2 * kGuardTexels, map.shape.height + 2 * kGuardTexels, 1);
}

bool ShadowMapKeeper::update(const GpuScene& scene, const SceneState& state, const ShadowMap& map,
                             const Options& options) {
    const std::vector<glm::dvec4> planes = options.cull ? map.shape.frustum.caster_planes : std::vector<glm::dvec4>{};
    const auto list = [&](Which which) { return draw_list(scene, state, planes, which, options.back_faces); };
    DrawList moving = list(Which::moving_casters);
    Content still{scene.serial, map.shape, list(Which::still_casters), {}};
    Content content = still;
    content.casters.items.insert(content.casters.items.end(), moving.items.begin(), moving.items.end());
    for (const DrawList::Item& item : moving.items)
        content.movers.push_back(world_from_model(scene.draws[item.draw], state));

    const bool same_memory = drawn_into_ == map.memory.depth.id();
    const bool nothing_changed = options.keep && same_memory && drawn_ && drawn_->same_as(content);
    triangles_ = 0;
    if (nothing_changed) return false;
    // Worth a copy once it is clear that only casters move.
    const bool only_movers = options.keep && !moving.items.empty() && !still.casters.items.empty() && drawn_ &&
                             drawn_->scene == scene.serial && drawn_->shape.texels_equal(map.shape);
    if (only_movers) {
        if (!still_ || !still_->same_as(still)) {
            const int side = map_texture_side(map.capacity);
            if (still_side_ != side || still_memory_.format != map.memory.format) {
                still_side_ = side;
                still_memory_ = make_depth_map(still_side_, still_side_, map.memory.format);
            }
            pass_.clear(still_memory_, map.shape);
            pass_.draw(scene, state, still.casters, still_memory_, map.shape);
            triangles_ += triangle_count(still.casters);
            still_ = std::move(still);
        }
        copy_still_casters(map);
        pass_.draw(scene, state, moving, map.memory, map.shape);
        triangles_ += triangle_count(moving);
    } else {
        still_.reset();
        pass_.clear(map.memory, map.shape);
        pass_.draw(scene, state, content.casters, map.memory, map.shape);
        triangles_ += triangle_count(content.casters);
    }
    drawn_into_ = map.memory.depth.id();
    drawn_ = std::move(content);
    return true;
}

}  // namespace stairstep
