#include "renderer/shadow_map.h"

#include <algorithm>
#include <bit>

namespace stairstep {

DepthMap make_depth_map(int width, int height) {
    gl::Texture depth = gl::make_texture(GL_DEPTH_COMPONENT32F, width, height);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl::Framebuffer framebuffer = gl::make_framebuffer(0, depth.id());
    return {std::move(depth), std::move(framebuffer)};
}

ShadowMap reserve_shadow_map(int capacity) {
    const int side = capacity + 2 * kGuardTexels;
    return {capacity, make_depth_map(side, side), {}, 0};
}

int capacity_for(int side, int largest) {
    constexpr int kLeast = 256;
    return std::min(std::max(static_cast<int>(std::bit_ceil(static_cast<unsigned>(side))), kLeast), largest);
}

}  // namespace stairstep
