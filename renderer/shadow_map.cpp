#include "renderer/shadow_map.h"

namespace stairstep {

ShadowMap make_shadow_map(const ShadowMapShape& shape) {
    gl::Texture depth = gl::make_texture(GL_DEPTH_COMPONENT32F, shape.width, shape.height);
    const float empty[4] = {1, 1, 1, 1};
    gl::TextureParameteri(depth.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl::TextureParameteri(depth.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    gl::TextureParameterfv(depth.id(), GL_TEXTURE_BORDER_COLOR, empty);
    gl::Framebuffer framebuffer = gl::make_framebuffer(0, depth.id());
    return {shape, std::move(depth), std::move(framebuffer)};
}

}  // namespace stairstep
