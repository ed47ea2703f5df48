#include "renderer/frame.h"

#include <cmath>

#include "embedded/shaders.h"

namespace stairstep {
namespace {

/// Linear; about 86 % grey as displayed.
constexpr glm::vec3 kBackground(0.70f, 0.74f, 0.79f);

void draw_elements(const GpuScene::Draw& draw) {
    gl::DrawElements(GL_TRIANGLES, draw.index_count, GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(draw.first_index * sizeof(uint32_t)));
}

/// Casters as the light sees them, into the map.
void draw_depth_pass(const GpuScene& scene, const ShadowRenderer& shadows) {
    const ShadowMap& map = shadows.map;
    gl::set_uniform(shadows.depth_program, "texel_from_world", texel_from_world(map.shape));
    gl::set_uniform(shadows.depth_program, "map_size", glm::vec2(map.shape.width, map.shape.height));

    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, map.framebuffer.id());
    gl::Viewport(0, 0, map.shape.width, map.shape.height);
    const float empty = 1;
    gl::ClearNamedFramebufferfv(map.framebuffer.id(), GL_DEPTH, 0, &empty);
    gl::UseProgram(shadows.depth_program.id());
    for (const GpuScene::Draw& draw : scene.draws) {
        if (draw.casts) draw_elements(draw);
    }
}

/// What shaders/receiver.glsl needs to place a surface point in the map.
void set_receiver_uniforms(const gl::Program& program, const ShadowMapShape& shape, const glm::dvec3& eye) {
    const LightFrustum& frustum = shape.frustum;
    GLint subpixel_bits = 0;
    gl::GetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
    gl::set_uniform(program, "texel_from_world", texel_from_world(shape));
    gl::set_uniform(program, "light_from_world",
                    glm::transpose(glm::mat3(frustum.basis.right, frustum.basis.up, frustum.basis.back)));
    gl::set_uniform(program, "depth_per_texel", glm::vec2(shape.texel() / (frustum.farthest - frustum.nearest)));
    gl::set_uniform(program, "subpixel", std::ldexp(1.0f, -subpixel_bits));
    gl::set_uniform(program, "eye", glm::vec3(eye));
}

/// Everything as the camera sees it, lit through the technique.
void draw_lighting_pass(const GpuScene& scene, const FrameView& view, const ShadowRenderer& shadows,
                        const FrameTarget& target) {
    const bool colour = target.show == Show::colour;
    const gl::Program& program = colour ? shadows.colour_program : shadows.visibility_program;
    const glm::vec3 to_light(shadows.map.shape.frustum.basis.back);
    const double aspect = static_cast<double>(target.width) / target.height;
    gl::set_uniform(program, "clip_from_world", clip_from_world(view.camera, aspect));
    gl::set_uniform(program, "to_light", to_light);
    gl::set_uniform(program, "background", kBackground);
    gl::set_uniform(program, "middle", glm::vec3(view.middle));
    gl::set_uniform(program, "fade_near", static_cast<float>(1.2 * view.diagonal));
    set_receiver_uniforms(program, shadows.map.shape, view.camera.eye);
    shadows.technique->bind(program);

    const bool multisampled = target.multisample_framebuffer.id() != 0;
    const GLuint framebuffer = multisampled ? target.multisample_framebuffer.id() : target.framebuffer.id();
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl::Viewport(0, 0, target.width, target.height);
    const glm::vec4 background = colour ? glm::vec4(kBackground, 1) : glm::vec4(1);
    const float farthest = 1;
    gl::ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &background.x);
    gl::ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &farthest);
    gl::UseProgram(program.id());
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, scene.facet_normals.id());
    gl::BindTextureUnit(0, shadows.map.depth.id());
    for (const GpuScene::Draw& draw : scene.draws) {
        gl::set_uniform(program, "first_triangle", static_cast<int>(draw.first_index / 3));
        gl::set_uniform(program, "base_colour", draw.material.base_colour);
        gl::set_uniform(program, "textured", draw.material.texture ? 1 : 0);
        gl::set_uniform(program, "fade_far", draw.fades ? static_cast<float>(4 * view.diagonal) : -1.0f);
        if (draw.material.texture) gl::BindTextureUnit(1, scene.textures[*draw.material.texture].id());
        draw_elements(draw);
    }
    if (multisampled) {
        gl::BlitNamedFramebuffer(framebuffer, target.framebuffer.id(), 0, 0, target.width, target.height, 0, 0,
                                 target.width, target.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
}

/// GL's rows start at the bottom.
template <typename T>
void flip_rows(std::vector<T>& values, size_t row_length) {
    for (size_t low = 0, high = values.size(); high - low >= 2 * row_length;) {
        high -= row_length;
        std::swap_ranges(values.begin() + low, values.begin() + low + row_length, values.begin() + high);
        low += row_length;
    }
}

}  // namespace

FrameTime draw_frame(const GpuScene& scene, const FrameView& view, const ShadowRenderer& shadows,
                     const FrameTarget& target, gl::PassTimer& timer) {
    // State that both passes share; everything else is set where it is used.
    gl::ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl::Enable(GL_DEPTH_TEST);
    gl::Enable(GL_FRAMEBUFFER_SRGB);
    gl::BindVertexArray(scene.vertex_array.id());

    FrameTime time;
    if (shadows.technique->reads_map()) {
        timer.start();
        draw_depth_pass(scene, shadows);
        time.depth = timer.stop();
    }
    timer.start();
    draw_lighting_pass(scene, view, shadows, target);
    time.lighting = timer.stop();

    gl::throw_on_error("drawing a frame");
    return time;
}

FrameTarget make_frame_target(Show show, int width, int height, int samples) {
    FrameTarget target{show, width, height, {}, {}, {}, {}, {}};
    const GLenum format = show == Show::colour ? GL_SRGB8_ALPHA8 : GL_R32F;
    const bool multisampled = samples > 1 && show == Show::colour;
    target.colour = gl::make_texture(format, width, height);
    if (multisampled) {
        target.multisample_colour = gl::make_multisample_texture(format, width, height, samples);
        target.depth = gl::make_multisample_texture(GL_DEPTH_COMPONENT32F, width, height, samples);
        target.multisample_framebuffer = gl::make_framebuffer(target.multisample_colour.id(), target.depth.id());
        target.framebuffer = gl::make_framebuffer(target.colour.id(), 0);
    } else {
        target.depth = gl::make_texture(GL_DEPTH_COMPONENT32F, width, height);
        target.framebuffer = gl::make_framebuffer(target.colour.id(), target.depth.id());
    }
    return target;
}

ShadowRenderer make_shadow_renderer(const TechniqueEntry& entry, const TechniqueSettings& settings,
                                    const ShadowMapShape& shape) {
    ShadowRenderer renderer{make_shadow_map(shape), entry.make(settings, shape), {}, {}, {}};
    const std::string name(entry.name);
    const std::string_view shader = renderer.technique->shader();
    renderer.depth_program = gl::make_program("depth", {embedded::depth_vert}, {embedded::depth_frag});
    renderer.colour_program = gl::make_program(name + " lighting", {embedded::lighting_vert},
                                               {embedded::receiver_glsl, shader, embedded::lighting_frag});
    renderer.visibility_program = gl::make_program(name + " visibility", {embedded::lighting_vert},
                                                   {embedded::receiver_glsl, shader, embedded::visibility_frag});
    return renderer;
}

Image read_colour(const FrameTarget& target) {
    Image image(target.width, target.height, 3);
    gl::PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl::GetTextureImage(target.colour.id(), 0, GL_RGB, GL_UNSIGNED_BYTE, static_cast<GLsizei>(image.pixels.size()),
                        image.pixels.data());
    gl::throw_on_error("reading a picture");
    flip_rows(image.pixels, static_cast<size_t>(target.width) * 3);
    return image;
}

std::vector<float> read_visibility(const FrameTarget& target) {
    std::vector<float> values(static_cast<size_t>(target.width) * target.height);
    gl::GetTextureImage(target.colour.id(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)),
                        values.data());
    gl::throw_on_error("reading visibility");
    flip_rows(values, target.width);
    return values;
}

}  // namespace stairstep
