// A shadow map on the GPU: for each texel, the depth of the caster nearest to the light at the texel's
// centre.
#pragma once

#include "renderer/gl/objects.h"
#include "renderer/shadow_map_shape.h"

namespace stairstep {

/// A depth texture that can be drawn into: 32-bit float, unfiltered, and comparing nothing.
struct DepthMap {
    gl::Texture depth;
    gl::Framebuffer framebuffer;
};

/// Throws FailureError where the driver can't make one of this size.
DepthMap make_depth_map(int width, int height);

/// Empty texels on each side of a map's own in its texture, so that a filter that leaves the map reads light without a
/// test. shaders/receiver.glsl has the same number.
inline constexpr int kGuardTexels = 2;

/// Memory for maps of up to `capacity` texels a side, reserved once, and the map that it holds now: a part of it, behind
/// kGuardTexels of empty ones. Techniques read raw depths, so that each texel can be compared with the depth that the
/// receiver's plane has at this very texel.
struct ShadowMap {
    int capacity = 0;
    DepthMap memory;
    ShadowMapShape shape;
    /// Half-width of a constant filter, light plane.
    double filter_radius = 0;

    /// Side of the texture.
    int texture_side() const { return capacity + 2 * kGuardTexels; }
};

/// An empty map. Throws FailureError as make_depth_map.
ShadowMap reserve_shadow_map(int capacity);

}  // namespace stairstep
