#include "renderer/view_passes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "embedded/shaders.h"

namespace stairstep {
namespace {

/// Linear; about 86 % grey as displayed.
constexpr glm::vec3 kBackground(0.70f, 0.74f, 0.79f);
/// Share of a spot's cone over which its light fades.
constexpr double kConeFade = 0.15;
/// Units in the last place that a place in the map may be off by, after all matrices.
constexpr double kRoundings = 16;

double aspect_of(const FrameTarget& target) {
    return static_cast<double>(target.width) / target.height;
}

glm::dmat4 translation(const glm::dvec3& by) {
    glm::dmat4 matrix(1);
    matrix[3] = glm::dvec4(by, 1);
    return matrix;
}

/// Eye space has the world's axes around the camera's eye.
glm::mat4 eye_from_model(const GpuScene::Draw& draw, const SceneState& state) {
    return glm::mat4(translation(-state.camera.eye) * world_from_model(draw, state));
}

glm::mat4 clip_from_eye(const Camera& camera, double aspect) {
    Camera centred = camera;
    centred.eye = glm::dvec3(0);
    return glm::mat4(clip_from_world(centred, aspect));
}

/// How far a caster's plane or a receiver's place may be from where it is, texels: vertices snap to subpixels, and the largest
/// number that a place in the map is a sum of is rounded.
double misplaced_texels(const ShadowMapShape& shape, const glm::dvec3& eye) {
    GLint subpixel_bits = 0;
    gl::GetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
    const LightFrustum& frustum = shape.frustum;
    const glm::dvec3 centre(0.5 * (frustum.low + frustum.high), 0);
    const glm::dvec2 from_eye = frustum.kind == Light::Kind::directional
                                    ? glm::dvec2(light_plane_point(frustum, eye) - centre)
                                    : glm::dvec2(glm::length(eye - frustum.position) / frustum.farthest);
    const glm::dvec2 far_texels = glm::abs(from_eye) / shape.texel();
    const double largest =
        std::max({static_cast<double>(shape.width), static_cast<double>(shape.height), far_texels.x, far_texels.y});
    return std::ldexp(1.0, -subpixel_bits) + kRoundings * std::numeric_limits<float>::epsilon() * largest;
}

/// What shaders/lighting.vert and shaders/receiver.glsl need to place a surface point in the map.
void set_receiver_uniforms(const gl::Program& program, const ShadowMap& map, const SceneState& state) {
    const Light& light = state.light;
    const glm::dvec3& eye = state.camera.eye;
    const glm::dmat4 texel_from_eye = texel_from_world(map.shape) * translation(eye);
    const double cone = light.cone_deg * std::numbers::pi / 180;
    gl::set_uniform(program, "map_size", glm::vec2(map.shape.width, map.shape.height));
    gl::set_uniform(program, "map_scale", glm::vec2(1.0f / static_cast<float>(map.texture_side())));
    gl::set_uniform(program, "texel_side", glm::vec2(map.shape.texel()));
    gl::set_uniform(program, "light_from_eye", glm::vec3(light.position - eye));
    gl::set_uniform(program, "texel_from_eye", glm::mat4(texel_from_eye));
    gl::set_uniform(program, "texel_plane_from_eye", glm::mat4(glm::transpose(glm::inverse(texel_from_eye))));
    gl::set_uniform(program, "light_back", glm::vec3(light.basis.back));
    gl::set_uniform(program, "cone", glm::vec2(std::cos(cone * (1 - kConeFade)), std::cos(cone)));
    gl::set_uniform(program, "misplaced", static_cast<float>(misplaced_texels(map.shape, eye)));
}

/// A shader that knows its light's kind doesn't compute the other's.
std::string_view preamble(Light::Kind kind) {
    return kind == Light::Kind::spot ? "#version 450 core\nconst bool spot = true;\n"
                                     : "#version 450 core\nconst bool spot = false;\n";
}

const gl::Framebuffer& framebuffer_of(const FrameTarget& target, bool with_need) {
    if (target.samples > 1) return target.multisample_framebuffer;
    return with_need ? target.need_framebuffer : target.framebuffer;
}

void clear_depths(const gl::Framebuffer& framebuffer) {
    const float farthest = 1;
    gl::ClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &farthest);
}

}  // namespace

ViewDepthPass::ViewDepthPass()
    : program_(gl::make_program("view depth", {embedded::view_depth_vert}, {embedded::depth_frag})) {}

void ViewDepthPass::draw(const GpuScene& scene, const SceneState& state, const FrameTarget& target) const {
    const gl::Framebuffer& framebuffer = target.depth_framebuffer;
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.id());
    gl::Viewport(0, 0, target.width, target.height);
    clear_depths(framebuffer);
    gl::Enable(GL_DEPTH_TEST);
    // Of surfaces in the same place the last one shows, with this pass and without.
    gl::DepthFunc(GL_LEQUAL);
    gl::set_uniform(program_, "clip_from_eye", clip_from_eye(state.camera, aspect_of(target)));
    gl::UseProgram(program_.id());
    gl::BindVertexArray(scene.vertex_array.id());
    for (const GpuScene::Draw& draw : scene.draws) {
        gl::set_uniform(program_, "eye_from_model", eye_from_model(draw, state));
        draw_elements(draw);
    }
    gl::DepthFunc(GL_LESS);
}

const gl::Program& LightingPass::program(const ShadowTechnique& technique, Show show, Light::Kind light) {
    gl::Program& program = programs_[static_cast<size_t>(show)][static_cast<size_t>(light)];
    if (program.id()) return program;
    const bool colour = show == Show::colour;
    gl::ShaderParts parts{preamble(light), embedded::steepness_glsl, embedded::receiver_glsl};
    for (const std::string_view part : technique.shader()) parts.push_back(part);
    parts.push_back(colour ? embedded::lighting_frag : embedded::visibility_frag);
    return program = gl::make_program(name_ + (colour ? " lighting" : " visibility"),
                                      {preamble(light), embedded::steepness_glsl, embedded::lighting_vert}, parts);
}

void LightingPass::draw(const GpuScene& scene, const SceneState& state, const ShadowTechnique& technique,
                        const ShadowMap& map, const FrameTarget& target, const Options& options) {
    const gl::Program& program = this->program(technique, target.show, state.light.kind);
    gl::set_uniform(program, "clip_from_eye", clip_from_eye(state.camera, aspect_of(target)));
    gl::set_uniform(program, "background", kBackground);
    gl::set_uniform(program, "middle_from_eye", glm::vec3(scene.middle - state.camera.eye));
    gl::set_uniform(program, "fade_near", static_cast<float>(1.2 * scene.diagonal));
    set_receiver_uniforms(program, map, state);
    technique.bind(program, map);

    const gl::Framebuffer& framebuffer = framebuffer_of(target, options.with_need);
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.id());
    gl::Viewport(0, 0, target.width, target.height);
    const glm::vec4 background = target.show == Show::colour ? glm::vec4(kBackground, 1) : glm::vec4(1);
    const glm::vec4 no_need(1e30f);
    gl::ClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, &background.x);
    if (options.with_need) gl::ClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 1, &no_need.x);
    if (!options.depths_are_there) clear_depths(framebuffer);
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(options.depths_are_there ? GL_EQUAL : GL_LEQUAL);
    gl::Enable(GL_FRAMEBUFFER_SRGB);
    gl::UseProgram(program.id());
    gl::BindVertexArray(scene.vertex_array.id());
    gl::BindTextureUnit(0, map.memory.depth.id());
    for (const GpuScene::Draw& draw : scene.draws) {
        gl::set_uniform(program, "eye_from_model", eye_from_model(draw, state));
        gl::set_uniform(program, "base_colour", draw.material.base_colour);
        gl::set_uniform(program, "textured", draw.material.texture ? 1 : 0);
        gl::set_uniform(program, "fade_far", draw.fades ? static_cast<float>(4 * scene.diagonal) : -1.0f);
        if (draw.material.texture) gl::BindTextureUnit(1, scene.textures[*draw.material.texture].id());
        draw_elements(draw);
    }
    gl::DepthFunc(GL_LESS);
    if (target.samples > 1) {
        gl::BlitNamedFramebuffer(framebuffer.id(), target.framebuffer.id(), 0, 0, target.width, target.height, 0, 0,
                                 target.width, target.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
}

}  // namespace stairstep
