// A shadow map on the GPU: for each texel, the depth of the caster nearest to the light at the texel's
// centre.
#pragma once

#include "renderer/gl/objects.h"
#include "renderer/light_frustum.h"

namespace stairstep {

struct ShadowMap {
    ShadowMapShape shape;
    /// 32-bit float depth, [0, 1] in texel space; 1 is empty, and so is everything beyond the border. It
    /// isn't filtered and compares nothing: techniques read raw depths, so that each texel can be compared
    /// with the depth that the receiver's plane has at this very texel.
    gl::Texture depth;
    gl::Framebuffer framebuffer;
};

/// Throws FailureError where the driver can't make one of this size.
ShadowMap make_shadow_map(const ShadowMapShape& shape);

}  // namespace stairstep
