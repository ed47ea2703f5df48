// A shadow map filtered ahead of the lighting: what a technique keeps of each texel, averaged over the box filter, with
// mipmaps. Any filter then costs a pixel one look, and what lies between texels, or within a pixel, is filtered as well.
//
// A technique keeps up to four numbers of a texel, of which means tell what it needs; all are 0 where the texel is empty.
// The first should be 1 where it isn't: empty texels leave any receiver lit, also one that stands above the map's far end,
// so they are best kept apart from those that may block it.
//
//     mean(p) = Σ w(q − p)·kept(q) / Σ w(q − p)     at texel centres p; w: the area of texel q within the box of half-width r
//
// is the mean that pcf's exact filter takes there, texels at the rim counting by their part. Between centres the lookup
// interpolates, which for 2r odd is the same filter still; for others a straight edge's visibility, whose slope the box
// changes at once by 1/(2r) a texel, is off by at most 1/(8r) there, along each axis: 0.036 for the law's 3.47 texels. With
// r ≤ 1/2 texels are taken as they are, and a step between two is interpolated over their centres' distance: not hard.
//
// A filter of 16 texels and more is applied to blocks of texels instead, so many a side that it is 8 to 16 of them wide
// each way (off by at most 1/64, twice what its own texels would be at 4): a blur costs up to 33 fetches a block and axis,
// whatever the radius, and a look at each texel besides.
#pragma once

#include <string>
#include <string_view>

#include "renderer/gl/program.h"
#include "renderer/shadow_map.h"

namespace stairstep {

/// How a filter is applied along one axis.
struct PrefilterAxis {
    /// Texels of the shadow map a block, a power of two.
    double factor = 1;
    /// Half-width in blocks, at most kWidestPrefilter.
    double radius = 0;
    /// Blocks on each side of the middle one that the filter touches, and the part of the last that it covers, in (0, 1].
    int reach = 0;
    double end_weight = 1;
};

/// Half-width, in blocks, below which a filter stays.
inline constexpr double kWidestPrefilter = 16;

/// For a half-width ≥ 0 in texels: 3.47 has a factor of 1, a reach of 3 and an end weight of 0.97; 100 a factor of 8.
PrefilterAxis prefilter_axis(double radius_texels);

class PrefilteredMap {
  public:
    /// `kept` is GLSL that defines `vec4 kept(ivec2 texel)` (shaders/prefilter_texels.frag), `format` that of colours with as many
    /// floats as it keeps.
    PrefilteredMap(const std::string& name, std::string_view kept, GLenum format);

    /// For the uniforms of `kept`.
    const gl::Program& program() const { return texels_program_; }

    /// Filters a map just drawn with its filter_radius. Memory is as large as needed, and grows by doubling.
    void fill(const ShadowMap& map);

    /// Sets what shaders/prefiltered.glsl needs, on texture unit 2.
    void bind(const gl::Program& program) const;

    /// Of the filtered texels, the filter's reach around the map among them.
    glm::ivec2 size() const { return size_; }
    const PrefilterAxis& axis(int i) const { return axes_[i]; }

  private:
    void reserve(const glm::ivec2& size);
    void draw(const gl::Program& program, GLuint source, bool into_result, const glm::ivec2& size);

    GLenum format_;
    gl::Program texels_program_;
    gl::Program shrink_program_;
    gl::Program blur_program_;
    gl::VertexArray no_vertices_;
    glm::ivec2 capacity_{0};
    /// With mipmaps, and empty beyond `size_`.
    gl::Texture result_;
    gl::Texture scratch_;
    gl::Framebuffer result_framebuffer_;
    gl::Framebuffer scratch_framebuffer_;
    glm::ivec2 size_{0};
    PrefilterAxis axes_[2];
};

}  // namespace stairstep
