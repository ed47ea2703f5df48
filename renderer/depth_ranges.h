// The nearest and the farthest depth in every window of a shadow map: what tells, with one look, that a whole filter is lit
// or dark.
//
// Windows start at every fourth texel and are 12 texels wide, so that one holds all 8 × 8 texels that a law's box may touch
// wherever it starts. Small maps make them nearly free: two passes, of a fetch and of half a fetch a texel.
#pragma once

#include "renderer/gl/program.h"

namespace stairstep {

/// Texels between windows, and windows' width; shaders/ranges.glsl has the same numbers.
inline constexpr int kWindowStep = 4;
inline constexpr int kWindowWidth = 12;

class DepthRanges {
  public:
    DepthRanges();

    /// Finds the ranges of a texture's depths, texels [0, size); beyond it all is empty (1). Memory grows by doubling.
    void fill(GLuint depth_texture, const glm::ivec2& size);

    /// Sets what shaders/ranges.glsl needs, on texture unit 3.
    void bind(const gl::Program& program) const;

  private:
    void reserve(const glm::ivec2& blocks);

    /// Blocks that there is memory for.
    glm::ivec2 capacity_{0};
    gl::Program blocks_program_;
    gl::Program windows_program_;
    gl::VertexArray no_vertices_;
    /// RG32F: nearest and farthest.
    gl::Texture blocks_;
    gl::Texture windows_;
    gl::Framebuffer blocks_framebuffer_;
    gl::Framebuffer windows_framebuffer_;
    glm::ivec2 windows_count_{0};
};

}  // namespace stairstep
