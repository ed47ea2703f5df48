#include "renderer/prefiltered_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "embedded/shaders.h"

namespace stairstep {
namespace {

/// Texels a side that one step takes the mean of.
constexpr double kLargestBlock = 8;
/// Sides of memory are multiples of this, so that mipmaps down to here are means of whole 2 × 2.
constexpr int kGrain = 64;

int rounded_up(int count) {
    return (count + kGrain - 1) / kGrain * kGrain;
}

glm::ivec2 divided_up(const glm::ivec2& size, const glm::ivec2& block) {
    return (size + block - 1) / block;
}

/// The blocks of each step that together make blocks of `factor` texels; at least one step.
std::vector<glm::ivec2> steps_of(glm::dvec2 factor) {
    std::vector<glm::ivec2> steps;
    do {
        const glm::dvec2 block = glm::min(factor, glm::dvec2(kLargestBlock));
        steps.emplace_back(block);
        factor /= block;
    } while (factor.x > 1 || factor.y > 1);
    return steps;
}

}  // namespace

PrefilterAxis prefilter_axis(double radius_texels) {
    PrefilterAxis axis;
    axis.radius = radius_texels;
    while (axis.radius >= kWidestPrefilter) {
        axis.radius /= 2;
        axis.factor *= 2;
    }
    // The last block that the filter touches, from its middle block's centre; not one by rounding alone.
    axis.reach = std::max(0, static_cast<int>(std::ceil(axis.radius - 0.5 - 1e-6)));
    if (axis.reach > 0) axis.end_weight = std::min(axis.radius - (axis.reach - 0.5), 1.0);
    return axis;
}

PrefilteredMap::PrefilteredMap(const std::string& name, std::string_view kept, GLenum format)
    : format_(format),
      texels_program_(
          gl::make_program(name + " texels", {embedded::fullscreen_vert}, {embedded::prefilter_texels_frag, kept})),
      shrink_program_(
          gl::make_program("prefilter shrink", {embedded::fullscreen_vert}, {embedded::prefilter_shrink_frag})),
      blur_program_(gl::make_program("prefilter blur", {embedded::fullscreen_vert}, {embedded::prefilter_blur_frag})),
      no_vertices_(gl::make_vertex_array()) {}

void PrefilteredMap::reserve(const glm::ivec2& size) {
    if (size.x <= capacity_.x && size.y <= capacity_.y) return;
    for (const int axis : {0, 1}) {
        if (size[axis] > capacity_[axis]) capacity_[axis] = std::max(rounded_up(size[axis]), 2 * capacity_[axis]);
    }
    const auto levels = std::bit_width(static_cast<unsigned>(std::max(capacity_.x, capacity_.y)));
    result_ = gl::make_texture(format_, capacity_.x, capacity_.y, levels);
    scratch_ = gl::make_texture(format_, capacity_.x, capacity_.y);
    result_framebuffer_ = gl::make_framebuffer(result_.id(), 0);
    scratch_framebuffer_ = gl::make_framebuffer(scratch_.id(), 0);
    constexpr std::array<float, 4> kEmpty{};
    gl::TextureParameteri(result_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl::TextureParameteri(result_.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl::TextureParameteri(result_.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl::TextureParameteri(result_.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    gl::TextureParameterfv(result_.id(), GL_TEXTURE_BORDER_COLOR, kEmpty.data());
}

void PrefilteredMap::draw(const gl::Program& program, GLuint source, bool into_result, const glm::ivec2& size) {
    const gl::Framebuffer& framebuffer = into_result ? result_framebuffer_ : scratch_framebuffer_;
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.id());
    gl::Viewport(0, 0, size.x, size.y);
    gl::UseProgram(program.id());
    gl::BindTextureUnit(0, source);
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
}

void PrefilteredMap::fill(const ShadowMap& map) {
    const glm::ivec2 map_size(map.shape.width, map.shape.height);
    const glm::dvec2 radius = map.filter_radius / map.shape.texel();
    for (const int i : {0, 1}) axes_[i] = prefilter_axis(radius[i]);
    const std::vector<glm::ivec2> steps = steps_of({axes_[0].factor, axes_[1].factor});
    const glm::ivec2 reach(axes_[0].reach, axes_[1].reach);
    glm::ivec2 blocks = divided_up(map_size, steps.front());
    reserve(blocks + 2 * reach);
    gl::Disable(GL_DEPTH_TEST);
    gl::BindVertexArray(no_vertices_.id());

    // Each pass reads what the last one wrote, and the last of all writes the result.
    bool into_result = steps.size() % 2 == 1;
    gl::set_uniform(texels_program_, "map_size", glm::vec2(map_size));
    gl::set_uniform(texels_program_, "factor", glm::vec2(steps.front()));
    draw(texels_program_, map.memory.depth.id(), into_result, blocks);
    const auto pass = [&](const gl::Program& program, const glm::ivec2& size) {
        const GLuint source = into_result ? result_.id() : scratch_.id();
        into_result = !into_result;
        draw(program, source, into_result, size);
    };
    for (size_t i = 1; i < steps.size(); ++i) {
        gl::set_uniform(shrink_program_, "size", glm::vec2(blocks));
        gl::set_uniform(shrink_program_, "factor", glm::vec2(steps[i]));
        blocks = divided_up(blocks, steps[i]);
        pass(shrink_program_, blocks);
    }
    size_ = blocks;
    for (const int i : {0, 1}) {
        gl::set_uniform(blur_program_, "size", glm::vec2(size_));
        gl::set_uniform(blur_program_, "axis", glm::vec2(1 - i, i));
        gl::set_uniform(blur_program_, "reach", axes_[i].reach);
        gl::set_uniform(blur_program_, "end_weight", static_cast<float>(axes_[i].end_weight));
        size_[i] += 2 * reach[i];
        // Mipmaps take in what lies beyond.
        constexpr std::array<float, 4> kEmpty{};
        if (i == 1) gl::ClearNamedFramebufferfv(result_framebuffer_.id(), GL_COLOR, 0, kEmpty.data());
        pass(blur_program_, size_);
    }
    gl::GenerateTextureMipmap(result_.id());
}

void PrefilteredMap::bind(const gl::Program& program) const {
    gl::set_uniform(program, "prefiltered_factor", glm::vec2(axes_[0].factor, axes_[1].factor));
    gl::set_uniform(program, "prefiltered_border", glm::vec2(axes_[0].reach, axes_[1].reach));
    gl::set_uniform(program, "prefiltered_scale", glm::vec2(1) / glm::vec2(capacity_));
    gl::set_uniform(program, "prefiltered_radius",
                    glm::vec2(axes_[0].radius * axes_[0].factor, axes_[1].radius * axes_[1].factor));
    gl::BindTextureUnit(2, result_.id());
}

}  // namespace stairstep
