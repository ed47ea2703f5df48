#include "renderer/view_passes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "embedded/shaders.h"
#include "renderer/back_faces.h"

namespace stairstep {
namespace {

constexpr std::string_view kVersion = "#version 450 core\n";
/// Linear; about 86 % grey as displayed.
constexpr glm::vec3 kBackground(0.70f, 0.74f, 0.79f);
/// Where a fading mesh begins to and has become the background: from the scene's middle, in its diagonals.
constexpr glm::dvec2 kFade(1.2, 4);
/// Share of a spot's cone over which its light fades.
constexpr double kConeFade = 0.15;
/// Units in the last place that a place in the map may be off by, after all matrices.
constexpr double kMapRoundings = 16;
/// The same of a place in eye space.
constexpr double kEyeRoundings = 4;

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

/// With depths from 1 (near) to 0 (far), where floats are dense: depth falls with distance as fast as they grow denser, so that a
/// near plane close to the eye costs no precision.
glm::mat4 clip_from_eye(const Camera& camera, double aspect) {
    Camera centred = camera;
    centred.eye = glm::dvec3(0);
    glm::dmat4 reversed(1);
    reversed[2].z = -1;
    reversed[3].z = 1;
    return glm::mat4(reversed * clip_from_world(centred, aspect));
}

constexpr float kFarthestDepth = 0;

/// How far a caster's plane or a receiver's place may be from where it is.
struct Misplacement {
    /// Across the light, texels: vertices snap to subpixels, and the largest number that a place is a sum of is rounded.
    double texels = 0;
    /// Along the light, stored depth; of a spot at depth 1, falling with the depth's square.
    double depth = 0;
};

Misplacement misplacement(const ShadowMapShape& shape, const glm::dvec3& eye) {
    constexpr double kEpsilon = std::numeric_limits<float>::epsilon();
    GLint subpixel_bits = 0;
    gl::GetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
    const LightFrustum& frustum = shape.frustum;
    const bool spot = frustum.kind == Light::Kind::spot;
    const glm::dvec2 middle = 0.5 * (frustum.low + frustum.high);
    const double from_light = spot ? glm::distance(eye, frustum.position) : 0;
    const glm::dvec3 from_middle =
        light_plane_point(frustum, eye) - glm::dvec3(middle, 0.5 * (frustum.nearest + frustum.farthest));
    const double distance = spot ? from_light : glm::length(from_middle);
    const glm::dvec2 sideways = spot ? glm::dvec2(from_light / frustum.farthest) : glm::abs(glm::dvec2(from_middle));
    const glm::dvec2 eye_texels = sideways / shape.texel();
    double largest =
        std::max({static_cast<double>(shape.width), static_cast<double>(shape.height), eye_texels.x, eye_texels.y});
    if (frustum.warp.warps()) {
        // The eye's own place, of which all others are differences, isn't divided; a place near by is, by 1.
        const glm::dvec4 place = glm::abs(texel_from_world(shape) * glm::dvec4(eye, 1));
        const double side = std::max(shape.width, shape.height);
        largest = std::max({side, place.x, place.y, side * place.w});
    }
    const double depth_scale = (spot ? frustum.farthest * frustum.nearest : 1) / (frustum.farthest - frustum.nearest);
    return {std::ldexp(1.0, -subpixel_bits) + kMapRoundings * kEpsilon * largest,
            kEyeRoundings * kEpsilon * distance * depth_scale};
}

/// What shaders/receiver.glsl needs to place a surface point in the map.
void set_receiver_uniforms(const gl::Program& program, const ShadowMap& map, const SceneState& state, int height_px) {
    const Light& light = state.light;
    const glm::dvec3& eye = state.camera.eye;
    const glm::dmat4 texel_from_eye = texel_from_world(map.shape) * translation(eye);
    const double cone = light.cone_deg * std::numbers::pi / 180;
    const double pixel = pixel_footprint(state.camera, 1, height_px);
    gl::set_uniform(program, "map_size", glm::vec2(map.shape.width, map.shape.height));
    gl::set_uniform(program, "map_scale", glm::vec2(1) / glm::vec2(map.memory.size));
    gl::set_uniform(program, "texel_side", glm::vec2(map.shape.texel()));
    gl::set_uniform(program, "light_from_eye", glm::vec3(light.position - eye));
    gl::set_uniform(program, "texel_from_eye", glm::mat4(texel_from_eye));
    gl::set_uniform(program, "texel_plane_from_eye", glm::mat4(glm::transpose(glm::inverse(texel_from_eye))));
    gl::set_uniform(program, "light_back", glm::vec3(light.basis.back));
    gl::set_uniform(program, "cone", glm::vec2(std::cos(cone * (1 - kConeFade)), std::cos(cone)));
    const Misplacement misplaced = misplacement(map.shape, eye);
    gl::set_uniform(program, "misplaced", glm::vec2(misplaced.texels, misplaced.depth));
    gl::set_uniform(program, "depth_step", static_cast<float>(depth_step(map.memory.format)));
    gl::set_uniform(program, "depth_ends", glm::vec2(map.shape.frustum.nearest, map.shape.frustum.farthest));
    gl::set_uniform(program, "view_back", glm::vec3(state.camera.basis.back));
    gl::set_uniform(program, "pixel_area", static_cast<float>(pixel * pixel));
}

void set_lighting_uniforms(const gl::Program& program, const GpuScene& scene, const SceneState& state,
                           const LightPart& part) {
    gl::set_uniform(program, "first_light", part.index == 0 ? 1 : 0);
    gl::set_uniform(program, "share", static_cast<float>(1.0 / static_cast<double>(part.count)));
    if (part.slice) gl::set_uniform(program, "slice", glm::vec2(*part.slice));
    gl::set_uniform(program, "background", kBackground);
    gl::set_uniform(program, "middle_from_eye", glm::vec3(scene.middle - state.camera.eye));
    gl::set_uniform(program, "fade_range", glm::vec2(kFade * scene.diagonal));
}

/// A shader that knows what it is for doesn't compute the rest.
std::string constant(const char* name, bool value) {
    return "const bool " + std::string(name) + (value ? " = true;\n" : " = false;\n");
}

gl::Program make_surface_program(bool textured) {
    return gl::make_program("surface", {embedded::surface_vert},
                            {kVersion, constant("textured", textured), embedded::surface_glsl,
                             embedded::surface_drawn_glsl, embedded::surface_frag});
}

/// Whether no other part of the picture is lit before: of several slices the first has the nearest surfaces.
bool is_first(const LightPart& part) {
    return part.index == 0 && (!part.slice || part.slice->x < 0);
}

/// The picture as it is where nothing is, before anything is lit; and pixels that need nothing, of each light and slice.
void clear_lit(GLuint framebuffer, const FrameTarget& target, const LightPart& part) {
    const glm::vec4 background = target.show == Show::colour ? glm::vec4(kBackground, 1) : glm::vec4(1);
    const glm::vec4 no_need(1e30f);
    // Colours that are cleared to are encoded as those that are drawn.
    gl::Enable(GL_FRAMEBUFFER_SRGB);
    if (is_first(part)) gl::ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &background.x);
    if (part.need) gl::ClearNamedFramebufferfv(framebuffer, GL_COLOR, 1, &no_need.x);
}

/// Those whose material has a texture, or those without.
DrawList with_texture(const GpuScene& scene, const DrawList& surfaces, bool textured) {
    DrawList list{{}, surfaces.back_faces};
    for (const DrawList::Item& item : surfaces.items) {
        if (scene.draws[item.draw].material.texture.has_value() == textured) list.items.push_back(item);
    }
    return list;
}

void draw_surfaces(const gl::Program& program, const GpuScene& scene, const SceneState& state, const DrawList& surfaces,
                   const FrameTarget& target) {
    gl::Viewport(0, 0, target.width, target.height);
    gl::Enable(GL_DEPTH_TEST);
    // Lights after the first meet the same depths again.
    gl::DepthFunc(GL_GEQUAL);
    gl::set_uniform(program, "clip_from_eye", clip_from_eye(state.camera, aspect_of(target)));
    gl::UseProgram(program.id());
    gl::BindVertexArray(scene.vertex_array.id());
    const std::vector<glm::dvec3> starts = ray_starts(state.camera, aspect_of(target));
    for (const DrawList::Item& item : surfaces.items) {
        const GpuScene::Draw& draw = scene.draws[item.draw];
        if (!surfaces.back_faces) set_faces(draw, state, starts);
        gl::set_uniform(program, "eye_from_model", eye_from_model(draw, state));
        gl::set_uniform(program, "base_colour", draw.material.base_colour);
        gl::set_uniform(program, "fading", draw.fades ? 1 : 0);
        if (draw.material.texture) gl::BindTextureUnit(1, scene.textures[*draw.material.texture].id());
        draw_runs(scene, item);
    }
    set_both_faces();
    gl::DepthFunc(GL_LESS);
}

/// Adds to the picture that is there, for all lights but the first. Needs and what is kept are each light's own.
void set_blending(const LightPart& part) {
    if (part.index == 0) return;
    gl::Enablei(GL_BLEND, 0);
    gl::BlendFunc(GL_ONE, GL_ONE);
}

}  // namespace

void set_ray_uniforms(const gl::Program& program, const Camera& camera, const FrameTarget& target) {
    const double pixel = pixel_footprint(camera, 1, target.height);
    const auto& [right, up, back] = camera.basis;
    gl::set_uniform(
        program, "ray_corner",
        glm::vec3(-back -
                  0.5 * pixel * (static_cast<double>(target.width) * right + static_cast<double>(target.height) * up)));
    gl::set_uniform(program, "ray_right", glm::vec3(pixel * right));
    gl::set_uniform(program, "ray_up", glm::vec3(pixel * up));
}

SurfacePass::SurfacePass() : programs_{make_surface_program(false), make_surface_program(true)} {}

void SurfacePass::draw(const GpuScene& scene, const SceneState& state, const DrawList& surfaces,
                       const FrameTarget& target) {
    ++*target.stored_surfaces;
    const glm::vec4 nothing(0);
    // Where there is no plane, the material is never shown.
    gl::ClearNamedFramebufferfv(target.surface_framebuffer.id(), GL_COLOR, 0, &nothing.x);
    gl::ClearNamedFramebufferfv(target.surface_framebuffer.id(), GL_DEPTH, 0, &kFarthestDepth);
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.surface_framebuffer.id());
    fragments_.start();
    for (const bool textured : {false, true}) {
        draw_surfaces(programs_[textured], scene, state, with_texture(scene, surfaces, textured), target);
    }
    fragments_.stop();
}

LightingPass::LightingPass(std::string name) : name_(std::move(name)), no_vertices_(gl::make_vertex_array()) {}

LightingPass::Mapping LightingPass::mapping_of(const LightFrustum& frustum) {
    if (frustum.warp.warps()) return Mapping::warped;
    if (frustum.kind == Light::Kind::directional) return Mapping::directional;
    return frustum.stores_planes() ? Mapping::spot : Mapping::linear_spot;
}

const gl::Program& LightingPass::program(Source source, const ShadowTechnique& technique, const ShadowMap& map,
                                         Show show, const LightPart& part) {
    std::vector<std::string_view> visibility;
    switch (part.visibility) {
        case LightPart::Visibility::computed: visibility = technique.shader(map); break;
        case LightPart::Visibility::all_lit: visibility = {embedded::none_glsl}; break;
        case LightPart::Visibility::kept: visibility = {embedded::kept_glsl}; break;
    }
    const Mapping mapping = mapping_of(map.shape.frustum);
    Key key{source, show, mapping, part.slice.has_value(), {}};
    for (const std::string_view text : visibility) key.technique.push_back(text.data());
    gl::Program& program = programs_[key];
    if (program.id()) return program;
    const bool drawn = source != Source::stored;
    const bool colour = show == Show::colour;
    const bool spot = mapping == Mapping::spot || mapping == Mapping::linear_spot;
    const std::string first = std::string(kVersion) + constant("spot", spot) +
                              constant("warped", mapping == Mapping::warped) +
                              constant("linear_depth", mapping == Mapping::linear_spot) +
                              constant("sliced", key.sliced) + constant("textured", source == Source::drawn_textured);
    gl::ShaderParts parts{first, embedded::surface_glsl,
                          drawn ? embedded::surface_drawn_glsl : embedded::surface_stored_glsl, embedded::receiver_glsl,
                          embedded::slice_glsl};
    parts.insert(parts.end(), visibility.begin(), visibility.end());
    parts.push_back(colour ? embedded::lighting_frag : embedded::visibility_frag);
    return program = gl::make_program(name_ + (colour ? " lighting" : " visibility"),
                                      {drawn ? embedded::surface_vert : embedded::fullscreen_vert}, parts);
}

void LightingPass::light_stored(const GpuScene& scene, const SceneState& state, const ShadowTechnique& technique,
                                const ShadowMap& map, const FrameTarget& target, const LightPart& part) {
    const gl::Program& program = this->program(Source::stored, technique, map, target.show, part);
    set_lighting_uniforms(program, scene, state, part);
    set_receiver_uniforms(program, map, state, target.height);
    set_ray_uniforms(program, state.camera, target);
    if (part.visibility == LightPart::Visibility::computed) technique.bind(program, map);
    const GLuint own = (part.need ? target.need_framebuffer : target.framebuffer).id();
    const GLuint framebuffer = part.framebuffer ? part.framebuffer : own;
    clear_lit(framebuffer, target, part);
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl::Viewport(0, 0, target.width, target.height);
    // Only where something is: the triangle lies at the farthest depth, 0.
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    gl::DepthMask(GL_FALSE);
    set_blending(part);
    gl::UseProgram(program.id());
    gl::BindVertexArray(no_vertices_.id());
    gl::BindTextureUnit(0, map.memory.depth.id());
    gl::BindTextureUnit(4, target.planes.id());
    gl::BindTextureUnit(5, target.materials.id());
    if (part.visibility == LightPart::Visibility::kept) gl::BindTextureUnit(6, part.kept);
    if (part.index == 0) pixels_.start();
    gl::DrawArrays(GL_TRIANGLES, 0, 3);
    if (part.index == 0) pixels_.stop();
    gl::DepthMask(GL_TRUE);
    gl::Disable(GL_BLEND);
}

void LightingPass::draw_lit(const GpuScene& scene, const SceneState& state, const DrawList& surfaces,
                            const ShadowTechnique& technique, const ShadowMap& map, const FrameTarget& target,
                            const LightPart& part) {
    const gl::Framebuffer& framebuffer = target.samples > 1 ? target.multisample_framebuffer
                                         : part.need        ? target.need_framebuffer
                                                            : target.framebuffer;
    clear_lit(framebuffer.id(), target, part);
    if (is_first(part)) gl::ClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &kFarthestDepth);
    // Stored surfaces lose their depths.
    ++*target.stored_surfaces;
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.id());
    set_blending(part);
    gl::BindTextureUnit(0, map.memory.depth.id());
    for (const bool textured : {false, true}) {
        const DrawList list = with_texture(scene, surfaces, textured);
        if (list.items.empty()) continue;
        const gl::Program& program =
            this->program(textured ? Source::drawn_textured : Source::drawn, technique, map, target.show, part);
        set_lighting_uniforms(program, scene, state, part);
        set_receiver_uniforms(program, map, state, target.height);
        if (part.visibility == LightPart::Visibility::computed) technique.bind(program, map);
        draw_surfaces(program, scene, state, list, target);
    }
    gl::Disable(GL_BLEND);
    if (target.samples > 1) {
        gl::BlitNamedFramebuffer(framebuffer.id(), target.framebuffer.id(), 0, 0, target.width, target.height, 0, 0,
                                 target.width, target.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
}

}  // namespace stairstep
