#include "renderer/depth_ranges.h"

#include <algorithm>
#include <bit>

#include "embedded/shaders.h"

namespace stairstep {
namespace {

/// Windows that start before the first texel: the last of them starts at −4.
constexpr int kBefore = kWindowWidth / kWindowStep;

glm::ivec2 blocks_of(const glm::ivec2& size) {
    return (size + kWindowStep - 1) / kWindowStep;
}

}  // namespace

DepthRanges::DepthRanges()
    : blocks_program_(gl::make_program("range blocks", {embedded::fullscreen_vert}, {embedded::range_blocks_frag})),
      windows_program_(gl::make_program("range windows", {embedded::fullscreen_vert}, {embedded::range_windows_frag})),
      no_vertices_(gl::make_vertex_array()) {}

void DepthRanges::reserve(const glm::ivec2& blocks) {
    if (blocks.x <= capacity_.x && blocks.y <= capacity_.y) return;
    for (const int axis : {0, 1}) {
        const auto wanted = std::bit_ceil(static_cast<unsigned>(blocks[axis]));
        capacity_[axis] = std::max(capacity_[axis], static_cast<int>(wanted));
    }
    blocks_ = gl::make_texture(GL_RGBA32F, capacity_.x, capacity_.y);
    windows_ = gl::make_texture(GL_RGBA32F, capacity_.x + kBefore + 1, capacity_.y + kBefore + 1);
    blocks_framebuffer_ = gl::make_framebuffer(blocks_.id(), 0);
    windows_framebuffer_ = gl::make_framebuffer(windows_.id(), 0);
}

void DepthRanges::fill(GLuint depth_texture, const glm::ivec2& size) {
    const glm::ivec2 blocks = blocks_of(size);
    reserve(blocks);
    windows_count_ = blocks + kBefore + 1;
    gl::Disable(GL_DEPTH_TEST);
    gl::BindVertexArray(no_vertices_.id());

    gl::set_uniform(blocks_program_, "size", glm::vec2(size));
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, blocks_framebuffer_.id());
    gl::Viewport(0, 0, blocks.x, blocks.y);
    gl::UseProgram(blocks_program_.id());
    gl::BindTextureUnit(0, depth_texture);
    gl::DrawArrays(GL_TRIANGLES, 0, 3);

    gl::set_uniform(windows_program_, "blocks", glm::vec2(blocks));
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, windows_framebuffer_.id());
    gl::Viewport(0, 0, windows_count_.x, windows_count_.y);
    gl::UseProgram(windows_program_.id());
    gl::BindTextureUnit(0, blocks_.id());
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
}

void DepthRanges::bind(const gl::Program& program) const {
    gl::set_uniform(program, "last_window", glm::vec2(windows_count_ - 1));
    gl::BindTextureUnit(3, windows_.id());
}

}  // namespace stairstep
