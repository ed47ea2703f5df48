// What lies in every window of a shadow map: what tells, with one look, that a whole filter is lit or dark.
//
// Of each window two bounds are kept: a plane that none of its casters lies before, and its farthest depth. The plane follows
// the slope of what the window shows: a surface that the light meets at an angle isn't nearer than itself, and with a constant
// bound every sloped floor would count as a penumbra. It is found in blocks of 4 × 4 texels from the smallest steps between
// neighbours, as steps over edges are larger, and of the slopes of a window's blocks it takes the one whose bound lies farthest
// back.
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
    /// RGBA32F: the plane's change along x and y, per texel, and its depth at the centre; the farthest depth.
    gl::Texture blocks_;
    gl::Texture windows_;
    gl::Framebuffer blocks_framebuffer_;
    gl::Framebuffer windows_framebuffer_;
    glm::ivec2 windows_count_{0};
};

}  // namespace stairstep
