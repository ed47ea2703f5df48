// A shadow map on the GPU: for each texel, the depth of the caster nearest to the light at the texel's
// centre.
#pragma once

#include "renderer/depth_encoding.h"
#include "renderer/gl/objects.h"
#include "renderer/shadow_map_shape.h"

namespace stairstep {

/// A depth texture that can be drawn into: unfiltered, and comparing nothing.
struct DepthMap {
    gl::Texture depth;
    gl::Framebuffer framebuffer;
    DepthFormat format = DepthFormat::float32;
    /// Width and height of the texture, texels.
    glm::ivec2 size{0};
};

/// Throws FailureError where the driver can't make one of this size.
DepthMap make_depth_map(int width, int height, DepthFormat format = DepthFormat::float32);

/// Empty texels on each side of a map's own in its texture, so that a filter that leaves the map reads light without a
/// test. shaders/receiver.glsl has the same number.
inline constexpr int kGuardTexels = 2;

/// Memory for maps of up to `capacity` texels a side, and the map that it holds now: a part of it, behind kGuardTexels of
/// empty ones. Beside the part for maps a technique may keep what it makes of them (map_levels.h). Techniques read raw depths,
/// so that each texel can be compared with the depth that the receiver's plane has at this very texel.
struct ShadowMap {
    int capacity = 0;
    DepthMap memory;
    ShadowMapShape shape;
    /// Half-width of a constant filter, light plane.
    double filter_radius = 0;
};

/// Width and height of a texture for maps alone, of up to `capacity` texels a side.
constexpr int map_texture_side(int capacity) {
    return capacity + 2 * kGuardTexels;
}

/// A map of whatever its memory held. Throws FailureError as make_depth_map.
ShadowMap reserve_shadow_map(int capacity, DepthFormat format = DepthFormat::float32);
/// In a texture of this size, at least map_texture_side(capacity) each way.
ShadowMap reserve_shadow_map(int capacity, DepthFormat format, const glm::ivec2& texture_size);

/// The capacity for maps of this many texels a side: a power of two, or `largest` where that is less. Memory that grows by
/// doubling is reserved a few times in a program's life; the largest from the start would cost each frame, as what is drawn
/// into large memory is slower (of 8192² by 4 ms a pass on llvmpipe) however small a part it fills.
int capacity_for(int side, int largest);

}  // namespace stairstep
