#include "renderer/texel_quads.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>

#include "embedded/shaders.h"

namespace stairstep {
namespace {

/// Beyond a power of two: what the guard texels of a map of such a size add.
constexpr int kSpare = 3;

int64_t area(const glm::ivec2& size) {
    return int64_t{size.x} * size.y;
}

}  // namespace

TexelQuads::TexelQuads()
    : program_(gl::make_program("texel quads", {embedded::fullscreen_vert}, {embedded::texel_quads_frag})),
      no_vertices_(gl::make_vertex_array()) {}

void TexelQuads::reserve(const glm::ivec2& count) {
    if (count.x <= capacity_.x && count.y <= capacity_.y) return;
    GLint most = 0;
    gl::GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    glm::ivec2 wanted;
    for (const int axis : {0, 1}) {
        const auto doubled = std::bit_ceil(static_cast<unsigned>(std::max(count[axis] - kSpare, 1)));
        wanted[axis] = std::clamp(static_cast<int>(doubled) + kSpare, count[axis], std::max(most, count[axis]));
    }
    // A wide map after a high one would take the product of both.
    const glm::ivec2 both = glm::max(capacity_, wanted);
    capacity_ = area(both) <= 4 * area(wanted) ? both : wanted;
    quads_ = gl::make_texture(GL_RGBA32F, capacity_.x, capacity_.y);
    framebuffer_ = gl::make_framebuffer(quads_.id(), 0);
}

void TexelQuads::fill(GLuint depth_texture, const glm::ivec2& size) {
    assert(size.x >= 2 && size.y >= 2);
    const glm::ivec2 count = size - 1;
    reserve(count);
    gl::Disable(GL_DEPTH_TEST);
    gl::BindVertexArray(no_vertices_.id());
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.id());
    gl::Viewport(0, 0, count.x, count.y);
    gl::UseProgram(program_.id());
    gl::BindTextureUnit(0, depth_texture);
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
}

void TexelQuads::bind() const {
    gl::BindTextureUnit(2, quads_.id());
}

}  // namespace stairstep
