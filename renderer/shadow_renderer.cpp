#include "renderer/shadow_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "embedded/shaders.h"

namespace stairstep {
namespace {

/// Linear; about 86 % grey as displayed.
constexpr glm::vec3 kBackground(0.70f, 0.74f, 0.79f);
/// Share of a spot's cone over which its light fades.
constexpr double kConeFade = 0.15;
/// Across the longer side, of a map whose need isn't known yet.
constexpr double kFirstGuessTexels = 512;
/// Frames that a first frame's size may take to settle: the first guess, what it finds, and what that finds.
constexpr int kMostSettlingFrames = 4;

void draw_elements(const GpuScene::Draw& draw) {
    gl::DrawElements(GL_TRIANGLES, draw.index_count, GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(draw.first_index * sizeof(uint32_t)));
}

glm::dmat4 world_from_model(const GpuScene::Draw& draw, const SceneState& state) {
    return draw.mover ? state.movers[*draw.mover] : glm::dmat4(1);
}

/// Casters as the light sees them, into the map and the guard around it.
void draw_depth_pass(const GpuScene& scene, const SceneState& state, const ShadowMap& map, const gl::Program& program) {
    const int width = map.shape.width;
    const int height = map.shape.height;
    const glm::dmat4 texel_from_world = stairstep::texel_from_world(map.shape);
    gl::set_uniform(program, "map_size", glm::vec2(width, height));

    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, map.memory.framebuffer.id());
    gl::Enable(GL_SCISSOR_TEST);
    gl::Scissor(0, 0, width + 2 * kGuardTexels, height + 2 * kGuardTexels);
    const float empty = 1;
    gl::ClearNamedFramebufferfv(map.memory.framebuffer.id(), GL_DEPTH, 0, &empty);
    gl::Disable(GL_SCISSOR_TEST);
    gl::Viewport(kGuardTexels, kGuardTexels, width, height);
    gl::Enable(GL_DEPTH_TEST);
    // A caster nearer to a spot than its nearest depth still casts.
    gl::Enable(GL_DEPTH_CLAMP);
    gl::UseProgram(program.id());
    for (const GpuScene::Draw& draw : scene.draws) {
        if (!draw.casts) continue;
        gl::set_uniform(program, "texel_from_model", glm::mat4(texel_from_world * world_from_model(draw, state)));
        draw_elements(draw);
    }
    gl::Disable(GL_DEPTH_CLAMP);
}

/// What shaders/receiver.glsl needs to place a surface point in the map.
void set_receiver_uniforms(const gl::Program& program, const ShadowMap& map, const SceneState& state) {
    const Light& light = state.light;
    const glm::dvec3 origin = light.kind == Light::Kind::spot ? light.position : glm::dvec3(0);
    glm::dmat4 texel_from_light = texel_from_world(map.shape);
    texel_from_light[3] = texel_from_light * glm::dvec4(origin, 1);
    const double cone = light.cone_deg * std::numbers::pi / 180;
    GLint subpixel_bits = 0;
    gl::GetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
    gl::set_uniform(program, "map_size", glm::vec2(map.shape.width, map.shape.height));
    gl::set_uniform(program, "map_scale", glm::vec2(1.0f / static_cast<float>(map.texture_side())));
    gl::set_uniform(program, "texel_side", glm::vec2(map.shape.texel()));
    gl::set_uniform(program, "light_origin", glm::vec3(origin));
    gl::set_uniform(program, "texel_from_light", glm::mat4(texel_from_light));
    gl::set_uniform(program, "texel_plane_from_light", glm::mat4(glm::transpose(glm::inverse(texel_from_light))));
    gl::set_uniform(program, "light_back", glm::vec3(light.basis.back));
    gl::set_uniform(program, "cone", glm::vec2(std::cos(cone * (1 - kConeFade)), std::cos(cone)));
    gl::set_uniform(program, "subpixel", std::ldexp(1.0f, -subpixel_bits));
    gl::set_uniform(program, "eye", glm::vec3(state.camera.eye));
}

/// Everything as the camera sees it, lit through the technique.
void draw_lighting_pass(const GpuScene& scene, const SceneState& state, const ShadowTechnique& technique,
                        const ShadowMap& map, const gl::Program& program, const FrameTarget& target, bool with_need) {
    const double aspect = static_cast<double>(target.width) / target.height;
    gl::set_uniform(program, "clip_from_world", clip_from_world(state.camera, aspect));
    gl::set_uniform(program, "background", kBackground);
    gl::set_uniform(program, "middle", glm::vec3(scene.middle));
    gl::set_uniform(program, "fade_near", static_cast<float>(1.2 * scene.diagonal));
    set_receiver_uniforms(program, map, state);
    technique.bind(program, map);

    const bool multisampled = target.samples > 1;
    const gl::Framebuffer& framebuffer = multisampled ? target.multisample_framebuffer
                                         : with_need  ? target.need_framebuffer
                                                      : target.framebuffer;
    gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.id());
    gl::Viewport(0, 0, target.width, target.height);
    const glm::vec4 background = target.show == Show::colour ? glm::vec4(kBackground, 1) : glm::vec4(1);
    const glm::vec4 no_need(1e30f);
    const float farthest = 1;
    gl::ClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, &background.x);
    if (with_need) gl::ClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 1, &no_need.x);
    gl::ClearNamedFramebufferfv(framebuffer.id(), GL_DEPTH, 0, &farthest);
    gl::Enable(GL_DEPTH_TEST);
    gl::Enable(GL_FRAMEBUFFER_SRGB);
    gl::UseProgram(program.id());
    gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, scene.facet_normals.id());
    gl::BindTextureUnit(0, map.memory.depth.id());
    for (const GpuScene::Draw& draw : scene.draws) {
        gl::set_uniform(program, "world_from_model", glm::mat4(world_from_model(draw, state)));
        gl::set_uniform(program, "first_triangle", static_cast<int>(draw.first_index / 3));
        gl::set_uniform(program, "base_colour", draw.material.base_colour);
        gl::set_uniform(program, "textured", draw.material.texture ? 1 : 0);
        gl::set_uniform(program, "fade_far", draw.fades ? static_cast<float>(4 * scene.diagonal) : -1.0f);
        if (draw.material.texture) gl::BindTextureUnit(1, scene.textures[*draw.material.texture].id());
        draw_elements(draw);
    }
    if (multisampled) {
        gl::BlitNamedFramebuffer(framebuffer.id(), target.framebuffer.id(), 0, 0, target.width, target.height, 0, 0,
                                 target.width, target.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
}

/// Half-width of the constant filter in the light plane.
double light_plane_radius(double radius, const Light& light, const glm::dvec3& middle) {
    if (light.kind == Light::Kind::directional) return radius;
    return radius / std::max(depth_along(light, middle), 1e-9);
}

/// A shader that knows its light's kind doesn't compute the other's.
std::string_view preamble(Light::Kind kind) {
    return kind == Light::Kind::spot ? "#version 450 core\nconst bool spot = true;\n"
                                     : "#version 450 core\nconst bool spot = false;\n";
}

gl::Program lighting_program(const std::string& name, const ShadowTechnique& technique, Light::Kind light,
                             std::string_view what) {
    gl::ShaderParts parts{preamble(light), embedded::receiver_glsl};
    for (const std::string_view part : technique.shader()) parts.push_back(part);
    parts.push_back(what);
    return gl::make_program(name, {embedded::lighting_vert}, parts);
}

}  // namespace

ShadowRenderer::ShadowRenderer(const TechniqueEntry& entry, const ShadowSettings& settings, const GpuScene& scene,
                               const SceneState& first, double aspect)
    : settings_(settings),
      name_(entry.name),
      map_(reserve_shadow_map(settings.fixed_size.value_or(capacity_for(1, settings.largest_size)))),
      depth_program_(gl::make_program("depth", {embedded::depth_vert}, {embedded::depth_frag})) {
    // A filter mode that is chosen by the map needs the first; a technique to say how far it looks isn't there yet.
    map_.filter_radius = light_plane_radius(settings.radius, first.light, scene.middle);
    const LightFrustum frustum =
        fit_light_frustum(scene.extents, first, aspect, settings.fit, [&](auto&) { return map_.filter_radius; });
    map_.shape =
        settings.fixed_size
            ? map_of_size(frustum, *settings.fixed_size)
            : map_by_law(frustum, {settings.technique.law_slope, map_.filter_radius, 0, 0, settings.largest_size});
    technique_ = entry.make(settings.technique, map_, !settings.fixed_size);
    if (!settings.fixed_size && technique_->measures_need()) meter_.emplace();
}

const gl::Program& ShadowRenderer::lighting(Show show, Light::Kind light) {
    gl::Program& program = programs_[static_cast<size_t>(show)][static_cast<size_t>(light)];
    if (!program.id()) {
        const bool colour = show == Show::colour;
        program = lighting_program(name_ + (colour ? " lighting" : " visibility"), *technique_, light,
                                   colour ? embedded::lighting_frag : embedded::visibility_frag);
    }
    return program;
}

ShadowMapShape ShadowRenderer::choose_shape(const LightFrustum& frustum, double filter_radius, const Camera& camera,
                                            int height_px) {
    if (settings_.fixed_size) return map_of_size(frustum, *settings_.fixed_size);
    const int largest = settings_.largest_size;
    if (meter_) {
        if (const std::optional<TileNeeds> needs = meter_->take()) {
            choice_ = choose_texel(choice_, needed_texel(*needs, settings_.statistic), settings_.patience);
        }
        const double longest = std::max(frustum.extent().x, frustum.extent().y);
        const double texel = choice_.texel > 0 ? choice_.texel : texel_on_ladder(longest / kFirstGuessTexels);
        return map_of_texels(frustum, texel, largest, ShadowMapShape::Limit::law);
    }
    // What a pixel covers where shadows are nearest; in the light plane it can only look smaller.
    double pixel = 0;
    if (std::isfinite(frustum.view_distance)) {
        pixel = pixel_footprint(camera, std::max(frustum.view_distance, camera.near), height_px);
        if (frustum.kind == Light::Kind::spot) pixel /= frustum.farthest;
    }
    return map_by_law(frustum, {settings_.technique.law_slope, filter_radius, 0, pixel, largest});
}

ShadowMapShape ShadowRenderer::fit(const GpuScene& scene, const SceneState& state, double aspect, int height_px) {
    const double filter_radius = light_plane_radius(settings_.radius, state.light, scene.middle);
    const LightFrustum frustum =
        fit_light_frustum(scene.extents, state, aspect, settings_.fit,
                          [&](const LightFrustum& unfitted) { return technique_->reach(unfitted, filter_radius); });
    return choose_shape(frustum, filter_radius, state.camera, height_px);
}

FrameTime ShadowRenderer::draw_with(const ShadowMapShape& shape, const GpuScene& scene, const SceneState& state,
                                    const FrameTarget& target, gl::PassTimer& timer) {
    const int side = std::max(shape.width, shape.height);
    if (side > map_.capacity) map_ = reserve_shadow_map(capacity_for(side, std::max(side, settings_.largest_size)));
    map_.shape = shape;
    map_.filter_radius = light_plane_radius(settings_.radius, state.light, scene.middle);
    FrameTime time;
    gl::ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl::BindVertexArray(scene.vertex_array.id());
    if (technique_->reads_map()) {
        timer.start();
        draw_depth_pass(scene, state, map_, depth_program_);
        time.depth = timer.stop();
        timer.start();
        technique_->prepare(map_);
        time.prepare = timer.stop();
    }
    const bool with_need = meter_ && target.samples == 1;
    timer.start();
    gl::BindVertexArray(scene.vertex_array.id());
    draw_lighting_pass(scene, state, *technique_, map_, lighting(target.show, state.light.kind), target, with_need);
    time.lighting = timer.stop();
    if (with_need) {
        timer.start();
        meter_->measure(target);
        time.need = timer.stop();
    }
    gl::throw_on_error("drawing a frame");
    return time;
}

FrameTime ShadowRenderer::draw_fitted(const GpuScene& scene, const SceneState& state, const FrameTarget& target,
                                      gl::PassTimer& timer) {
    const auto started = std::chrono::steady_clock::now();
    const ShadowMapShape shape = fit(scene, state, static_cast<double>(target.width) / target.height, target.height);
    const std::chrono::duration<double, std::milli> fitting = std::chrono::steady_clock::now() - started;
    FrameTime time = draw_with(shape, scene, state, target, timer);
    time.fit_ms = fitting.count();
    return time;
}

FrameTime ShadowRenderer::draw(const GpuScene& scene, const SceneState& state, const FrameTarget& target,
                               gl::PassTimer& timer) {
    const bool settles = meter_ && target.samples == 1 && choice_.texel == 0;
    FrameTime time = draw_fitted(scene, state, target, timer);
    for (int i = 1; settles && i < kMostSettlingFrames; ++i) {
        const glm::dvec2 texel = map_.shape.texel();
        time = draw_fitted(scene, state, target, timer);
        if (map_.shape.texel() == texel) break;
    }
    return time;
}

}  // namespace stairstep
