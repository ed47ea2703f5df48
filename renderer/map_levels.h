// Coarser levels of a shadow map, point-sampled from it.
//
// A level of factor f holds what a map of f times the texel would: the depth at the centre of each of its texels, which is
// one of the finest map's texels. So a level is a shadow map in its own right, without bias, and costs a fetch a texel.
// Factors are 1, 2, 3, 4, 6, 8, 12, 16 …: an even factor's grid is moved by half a fine texel, which puts its texels'
// centres on the finest map's. All levels lie in one texture, as a shader can't choose between several: in the map's own, beside
// the map, which so is its first level without a copy. A depth that is read is one that can be stored: what levels hold is the
// map's to the bit in floats and in 16 bits. Floats don't tell all of 24 bits apart, and there it may be a step off, of which
// receivers leave more than thirty to rounding (kRounding of shaders/receiver.glsl).
#pragma once

#include <vector>

#include "renderer/depth_ranges.h"
#include "renderer/gl/program.h"
#include "renderer/shadow_map.h"

namespace stairstep {

/// Most levels: factors up to 4096. The shader's array is as long.
inline constexpr int kMostLevels = 24;

/// Factor of level i ≥ 0.
constexpr int level_factor(int level) {
    return level == 0 ? 1 : level % 2 == 1 ? 1 << (level + 1) / 2 : 3 << (level / 2 - 1);
}

/// Where a level lies in its texture, guard texels left out.
struct LevelPlace {
    int factor = 1;
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// The levels of a map of this size, down to one whose longer side is at most 4 texels. They and the kGuardTexels around
/// each don't overlap, and lie within levels_texture_size(max(width, height)).
std::vector<LevelPlace> level_places(int width, int height);

/// Width and height of the texture that holds any map of up to `capacity` texels a side, and its levels: about 11/6 times
/// as wide as the map.
glm::ivec2 levels_texture_size(int capacity);

/// Memory for maps of up to so many texels a side and their levels; all empty. Throws FailureError as make_depth_map.
ShadowMap reserve_map_with_levels(int capacity, DepthFormat format = DepthFormat::float32);

class MapLevels {
  public:
    /// Without ranges, no window tells that all it holds is lit.
    explicit MapLevels(bool with_ranges);

    /// Fills the levels beside a map of reserve_map_with_levels, and finds the ranges of their depths where there are few enough.
    void fill(const ShadowMap& map);

    const std::vector<LevelPlace>& places() const { return places_; }

    /// Sets what shaders/pcss_levels.glsl needs of the map that was filled last, on texture units 2 and 3.
    void bind(const gl::Program& program, const ShadowMap& map) const;

  private:
    gl::Program program_;
    gl::VertexArray no_vertices_;
    bool wants_ranges_;
    DepthRanges ranges_;
    bool has_ranges_ = false;
    std::vector<LevelPlace> places_;
};

}  // namespace stairstep
