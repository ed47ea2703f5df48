#include "renderer/shadow_map.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace stairstep {

namespace {

GLenum gl_format(DepthFormat format) {
    switch (format) {
        case DepthFormat::unorm16: return GL_DEPTH_COMPONENT16;
        case DepthFormat::unorm24: return GL_DEPTH_COMPONENT24;
        case DepthFormat::float32: return GL_DEPTH_COMPONENT32F;
    }
    return GL_DEPTH_COMPONENT32F;
}

}  // namespace

DepthMap make_depth_map(int width, int height, DepthFormat format) {
    gl::Texture depth = gl::make_texture(gl_format(format), width, height);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl::Framebuffer framebuffer = gl::make_framebuffer(0, depth.id());
    return {std::move(depth), std::move(framebuffer), format, {width, height}};
}

ShadowMap reserve_shadow_map(int capacity, DepthFormat format) {
    return reserve_shadow_map(capacity, format, glm::ivec2(map_texture_side(capacity)));
}

ShadowMap reserve_shadow_map(int capacity, DepthFormat format, const glm::ivec2& texture_size) {
    assert(texture_size.x >= map_texture_side(capacity) && texture_size.y >= map_texture_side(capacity));
    return {capacity, make_depth_map(texture_size.x, texture_size.y, format), {}, 0};
}

int capacity_for(int side, int largest) {
    constexpr int kLeast = 256;
    return std::min(std::max(static_cast<int>(std::bit_ceil(static_cast<unsigned>(side))), kLeast), largest);
}

}  // namespace stairstep
