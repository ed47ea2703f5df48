#include "renderer/stimulus_renderer.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "embedded/shaders.h"
#include "renderer/gl/program.h"
#include "renderer/half_plane_map.h"
#include "renderer/shadow_map.h"

namespace stairstep {
namespace {

/// Depths along the view and the light, which look the same way. Empty texels hold 1.
constexpr float kOccluderDepth = 0.25f;
constexpr float kReceiverDepth = 0.75f;

/// A kernel this narrow, in texels, looks like a point; a narrower one's mass would drown in rounding.
constexpr double kNarrowest = 1e-5;

template <typename T>
gl::Buffer buffer_of(const std::vector<T>& values) {
    return gl::make_buffer(std::as_bytes(std::span(values)));
}

/// A convex or star-shaped outline at one depth, as a triangle fan from its first point.
void draw_fan(std::span<const glm::dvec2> outline, float depth) {
    std::vector<glm::vec3> corners;
    for (const glm::dvec2& point : outline) corners.emplace_back(point, depth);
    const gl::Buffer buffer = buffer_of(corners);
    const gl::VertexArray array = gl::make_vertex_array();
    gl::VertexArrayVertexBuffer(array.id(), 0, buffer.id(), 0, sizeof(glm::vec3));
    gl::EnableVertexArrayAttrib(array.id(), 0);
    gl::VertexArrayAttribFormat(array.id(), 0, 3, GL_FLOAT, GL_FALSE, 0);
    gl::VertexArrayAttribBinding(array.id(), 0, 0);
    gl::BindVertexArray(array.id());
    gl::DrawArrays(GL_TRIANGLE_FAN, 0, static_cast<GLsizei>(corners.size()));
}

/// Both passes look straight down on their plane: points are already in texels, or pixels, of what is drawn into.
void set_plane(const gl::Program& program, int width, int height) {
    gl::set_uniform(program, "texel_from_model", glm::mat4(1));
    gl::set_uniform(program, "map_size", glm::vec2(width, height));
}

void draw_depth_pass(const gl::Program& program, const HalfPlaneMap& half_plane, const DepthMap& map) {
    const float empty = 1;
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, map.framebuffer.id());
    gl::Viewport(0, 0, half_plane.width, half_plane.height);
    gl::ClearNamedFramebufferfv(map.framebuffer.id(), GL_DEPTH, 0, &empty);
    gl::Enable(GL_DEPTH_TEST);
    set_plane(program, half_plane.width, half_plane.height);
    gl::UseProgram(program.id());
    draw_fan(half_plane.occluder, kOccluderDepth);
}

/// Cosine and sine of the angle by which each pixel turns the taps, row by row from the bottom.
std::vector<glm::vec2> turns_of(const Stimulus& stimulus) {
    if (!stimulus.kernel.rotated) return {{1, 0}};
    std::vector<glm::vec2> turns;
    turns.reserve(static_cast<size_t>(stimulus.width_px) * stimulus.height_px);
    for (int row = stimulus.height_px - 1; row >= 0; --row) {
        for (int column = 0; column < stimulus.width_px; ++column) {
            const double angle = rotation_at(column, row, stimulus.kernel.seed);
            turns.emplace_back(std::cos(angle), std::sin(angle));
        }
    }
    return turns;
}

/// The kernel as shaders/stimulus.frag and what is joined to it want it.
class BoundKernel {
  public:
    BoundKernel(const gl::Program& program, const Stimulus& stimulus, const HalfPlaneMap& half_plane) {
        const Kernel& kernel = stimulus.kernel;
        const double radius = kernel.radius_px > 0 ? std::max(kernel.radius_px / stimulus.texel_px, kNarrowest) : 0;
        const double reach = radius * support(kernel.shape);
        // A texel's centre may lie half a texel beyond the reach on each axis, and half a texel more is for rounding.
        const double alike_beyond = (reach + 1) * (std::abs(half_plane.edge.x) + std::abs(half_plane.edge.y));
        gl::set_uniform(program, "radius", static_cast<float>(radius));
        gl::set_uniform(program, "reach", static_cast<float>(reach));
        gl::set_uniform(program, "edge", glm::vec3(half_plane.edge));
        gl::set_uniform(program, "alike_beyond", static_cast<float>(alike_beyond));
        bind(0, columns_ = buffer_of(half_plane.columns));
        bind(1, rows_ = buffer_of(half_plane.rows));
        if (kernel.shape != KernelShape::poisson) return;

        std::vector<glm::vec2> taps;
        for (const KernelTap& tap : poisson_taps(kernel.taps, kernel.seed)) taps.emplace_back(tap.x, tap.y);
        gl::set_uniform(program, "tap_count", kernel.taps);
        gl::set_uniform(program, "rotated", kernel.rotated ? 1 : 0);
        gl::set_uniform(program, "image_width", stimulus.width_px);
        bind(2, taps_ = buffer_of(taps));
        bind(3, turns_ = buffer_of(turns_of(stimulus)));
    }

  private:
    static void bind(GLuint binding, const gl::Buffer& buffer) {
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.id());
    }

    gl::Buffer columns_;
    gl::Buffer rows_;
    gl::Buffer taps_;
    gl::Buffer turns_;
};

/// The receiver: a rectangle that fills the screen. The filter asks the map for each of its pixels.
std::vector<float> draw_receiver(const gl::Program& program, const Stimulus& stimulus, const HalfPlaneMap& half_plane,
                                 const DepthMap& map) {
    const int width = stimulus.width_px;
    const int height = stimulus.height_px;
    const gl::Texture picture = gl::make_texture(GL_R32F, width, height);
    const gl::Framebuffer framebuffer = gl::make_framebuffer(picture.id(), 0);
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.id());
    gl::Viewport(0, 0, width, height);
    gl::Disable(GL_DEPTH_TEST);
    set_plane(program, width, height);
    gl::UseProgram(program.id());
    gl::BindTextureUnit(0, map.depth.id());
    const BoundKernel kernel(program, stimulus, half_plane);
    const std::array<glm::dvec2, 4> screen{{{0, 0}, {width, 0}, {width, height}, {0, height}}};
    draw_fan(screen, kReceiverDepth);

    std::vector<float> visibility(static_cast<size_t>(width) * height);
    gl::GetTextureImage(picture.id(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(visibility.size() * sizeof(float)),
                        visibility.data());
    return visibility;
}

}  // namespace

const gl::Program& StimulusRenderer::pcf_program(KernelShape shape) {
    gl::Program& program = pcf_programs_[shape];
    if (program.id()) return program;
    using namespace embedded;
    const std::string title = "stimulus " + std::string(name(shape));
    const auto by_texels = [&](std::string_view kernel) {
        return gl::make_program(title, {depth_vert}, {stimulus_glsl, kernel, stimulus_texels_glsl, stimulus_frag});
    };
    switch (shape) {
        case KernelShape::box: return program = by_texels(stimulus_box_glsl);
        case KernelShape::disk: return program = by_texels(stimulus_disk_glsl);
        case KernelShape::gaussian: return program = by_texels(stimulus_gaussian_glsl);
        case KernelShape::poisson: break;
    }
    return program = gl::make_program(title, {depth_vert}, {stimulus_glsl, stimulus_taps_glsl, stimulus_frag});
}

std::vector<double> StimulusRenderer::luminance(const Stimulus& stimulus) {
    if (!depth_program_.id())
        depth_program_ = gl::make_program("depth", {embedded::depth_vert}, {embedded::depth_frag});
    GLint subpixel_bits = 0;
    gl::GetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
    const HalfPlaneMap half_plane = half_plane_map(stimulus, 1 << subpixel_bits);
    const DepthMap map = make_depth_map(half_plane.width, half_plane.height);

    gl::ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    draw_depth_pass(depth_program_, half_plane, map);
    const std::vector<float> visibility = draw_receiver(pcf_program(stimulus.kernel.shape), stimulus, half_plane, map);
    gl::throw_on_error("drawing a stimulus");

    // GL's rows start at the bottom.
    const size_t width = stimulus.width_px;
    std::vector<double> pixels(visibility.size());
    for (size_t row = 0, below = visibility.size(); below > 0; row += width) {
        below -= width;
        std::transform(visibility.begin() + below, visibility.begin() + below + width, pixels.begin() + row,
                       [&](float v) { return stimulus.contrast * v; });
    }
    return pixels;
}

}  // namespace stairstep
