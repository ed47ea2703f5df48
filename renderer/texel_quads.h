// The depths of every four texels of a shadow map that share a corner, side by side: one texel of four channels for each corner.
//
// A filter that weighs every texel looks at them four at a time. textureGather finds those four in two rows of the map: on a
// processor that draws (llvmpipe), four loads from four addresses for each lane. Side by side they are one aligned load of 16
// bytes. Packing a map takes one pass, as long as some gathers of each texel, and 16 bytes a texel: worth it where pixels
// gather more than that, and the map is small.
//
// Corner (i, j) is that of texels (i, j) to (i + 1, j + 1): N × M texels have (N − 1) × (M − 1) corners. Its channels have
// textureGather's order, from the upper left clockwise: (i, j + 1), (i + 1, j + 1), (i + 1, j), (i, j). Of 2 × 2 texels with
// depths 1 2 / 3 4, the lower row first, the one quad is (3, 4, 2, 1).
#pragma once

#include "renderer/gl/program.h"

namespace stairstep {

class TexelQuads {
  public:
    TexelQuads();

    /// Packs a texture's depths, texels [0, size), at least 2 each way: a map with its guard texels. Memory grows by doubling.
    void fill(GLuint depth_texture, const glm::ivec2& size);

    /// For shaders/texel_quads.glsl, on texture unit 2.
    void bind() const;

    /// RGBA32F; quad (i, j) is texel (i, j).
    GLuint texture() const { return quads_.id(); }
    /// Width and height of that texture: at least those of what was packed last.
    const glm::ivec2& texture_size() const { return capacity_; }

  private:
    void reserve(const glm::ivec2& count);

    glm::ivec2 capacity_{0};
    gl::Program program_;
    gl::VertexArray no_vertices_;
    gl::Texture quads_;
    gl::Framebuffer framebuffer_;
};

}  // namespace stairstep
