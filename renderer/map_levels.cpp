#include "renderer/map_levels.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>

#include "embedded/shaders.h"

namespace stairstep {
namespace {

constexpr int kGuards = 2 * kGuardTexels;
constexpr int kCoarsest = 4;
/// Finding the ranges of more takes longer than they save. Those of the coarser levels alone are no gain in smaller maps: many looks
/// are into the map itself.
constexpr size_t kMostTexelsForRanges = size_t{2} << 20;

int divided_up(int a, int b) {
    return (a + b - 1) / b;
}

}  // namespace

std::vector<LevelPlace> level_places(int width, int height) {
    // The finest at the left, then a column of the powers of two and one of three times those.
    std::vector<LevelPlace> places{{1, kGuardTexels, kGuardTexels, width, height}};
    std::array<int, 2> column{width + kGuards + kGuardTexels,
                              width + divided_up(width, 2) + 2 * kGuards + kGuardTexels};
    std::array<int, 2> row{kGuardTexels, kGuardTexels};
    for (int level = 1; level < kMostLevels; ++level) {
        if (std::max(places.back().width, places.back().height) <= kCoarsest) break;
        const int factor = level_factor(level);
        const int chain = level % 2 == 1 ? 0 : 1;
        const LevelPlace place{factor, column[chain], row[chain], divided_up(width, factor),
                               divided_up(height, factor)};
        row[chain] += place.height + kGuards;
        places.push_back(place);
    }
    return places;
}

glm::ivec2 levels_texture_size(int capacity) {
    // Halves add up to no more than the whole, and each level may round up by one and has its guards.
    const int slack = kMostLevels / 2 * (kGuards + 1);
    return {capacity + divided_up(capacity, 2) + divided_up(capacity, 3) + 3 * kGuards, capacity + slack};
}

ShadowMap reserve_map_with_levels(int capacity, DepthFormat format) {
    ShadowMap map = reserve_shadow_map(capacity, format, levels_texture_size(capacity));
    // Ranges see what lies between levels as well: it must be depths.
    const float empty = 1;
    gl::ClearNamedFramebufferfv(map.memory.framebuffer.id(), GL_DEPTH, 0, &empty);
    return map;
}

MapLevels::MapLevels(bool with_ranges)
    : program_(gl::make_program("levels", {embedded::fullscreen_vert}, {embedded::map_level_frag})),
      no_vertices_(gl::make_vertex_array()),
      wants_ranges_(with_ranges) {}

void MapLevels::fill(const ShadowMap& map) {
    assert(map.memory.size == levels_texture_size(map.capacity));
    places_ = level_places(map.shape.width, map.shape.height);
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, map.memory.framebuffer.id());
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_ALWAYS);
    gl::UseProgram(program_.id());
    gl::BindVertexArray(no_vertices_.id());
    gl::BindTextureUnit(0, map.memory.depth.id());
    gl::set_uniform(program_, "map_size", glm::vec2(map.shape.width, map.shape.height));
    // The map was drawn into the texture that is read, and all that is drawn from here on lies elsewhere in it.
    gl::TextureBarrier();
    for (const LevelPlace& place : std::span(places_).subspan(1)) {
        gl::Viewport(place.x - kGuardTexels, place.y - kGuardTexels, place.width + kGuards, place.height + kGuards);
        gl::set_uniform(program_, "place", glm::vec2(place.x, place.y));
        gl::set_uniform(program_, "factor", place.factor);
        gl::DrawArrays(GL_TRIANGLES, 0, 3);
    }
    gl::DepthFunc(GL_LESS);
    gl::Disable(GL_DEPTH_TEST);
    has_ranges_ = wants_ranges_ && map.shape.texel_count() <= kMostTexelsForRanges;
    if (!has_ranges_) return;
    glm::ivec2 used(0);
    for (const LevelPlace& place : places_) {
        used = glm::max(used, glm::ivec2(place.x + place.width, place.y + place.height) + kGuardTexels);
    }
    ranges_.fill(map.memory.depth.id(), used);
}

void MapLevels::bind(const gl::Program& program, const ShadowMap& map) const {
    std::vector<glm::vec4> places;
    for (const LevelPlace& place : places_) places.emplace_back(place.x, place.y, place.width, place.height);
    gl::set_uniform(program, "level_place", places);
    gl::set_uniform(program, "level_count", static_cast<int>(places.size()));
    gl::set_uniform(program, "levels_scale", glm::vec2(1) / glm::vec2(map.memory.size));
    gl::BindTextureUnit(2, map.memory.depth.id());
    gl::set_uniform(program, "with_ranges", has_ranges_ ? 1 : 0);
    ranges_.bind(program);
}

}  // namespace stairstep
