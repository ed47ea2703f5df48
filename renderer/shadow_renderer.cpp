#include "renderer/shadow_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "stimuli/error.h"

namespace stairstep {
namespace {

/// Across the longer side, of a map whose need isn't known yet.
constexpr double kFirstGuessTexels = 512;
/// Frames that a first frame's size may take to settle: the first guess, what it finds, and what that finds.
constexpr int kMostSettlingFrames = 4;

/// Half-width of the constant filter in the light plane.
double light_plane_radius(double radius, const Light& light, const glm::dvec3& middle) {
    if (light.kind == Light::Kind::directional) return radius;
    return radius / std::max(depth_along(light, middle), 1e-9);
}

}  // namespace

ShadowRenderer::ShadowRenderer(const TechniqueEntry& entry, const ShadowSettings& settings, const GpuScene& scene,
                               const SceneState& first, double aspect)
    : settings_(settings),
      map_(reserve_shadow_map(settings.fixed_size.value_or(capacity_for(1, settings.largest_size)))),
      lighting_pass_(std::string(entry.name)) {
    // A filter mode that is chosen by the map needs the first; a technique to say how far it looks isn't there yet.
    map_.filter_radius = light_plane_radius(settings.radius, first.light, scene.middle);
    const LightFrustum frustum = fit_light_frustum(
        scene.extents, first, aspect, settings.fit, [&](auto&) { return map_.filter_radius; }, settings.warp);
    map_.shape =
        settings.fixed_size
            ? map_of_size(frustum, *settings.fixed_size)
            : map_by_law(frustum, {settings.technique.law_slope, map_.filter_radius, 0, 0, settings.largest_size});
    technique_ = entry.make(settings.technique, map_, !settings.fixed_size);
    if (settings.warp != Warp::none && !technique_->takes_warp()) {
        throw InputError("--warp lispsm", std::string(entry.name) + " filters texels that are all of one size",
                         "use hard or pcf, or --warp none");
    }
    if (!settings.fixed_size && technique_->measures_need()) meter_.emplace();
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
    const LightFrustum frustum = fit_light_frustum(
        scene.extents, state, aspect, settings_.fit,
        [&](const LightFrustum& unfitted) { return technique_->reach(unfitted, filter_radius); }, settings_.warp);
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
    if (technique_->reads_map()) {
        timer.start();
        depth_pass_.draw(scene, state, map_);
        time.depth = timer.stop();
        timer.start();
        technique_->prepare(map_);
        time.prepare = timer.stop();
    }
    // A surface of several samples can't be stored.
    const bool stored = settings_.skips.hidden_surfaces && target.samples == 1;
    const bool with_need = meter_ && target.samples == 1;
    if (stored) {
        timer.start();
        surface_pass_.draw(scene, state, target);
        time.surfaces = timer.stop();
    }
    timer.start();
    if (stored) {
        lighting_pass_.light_stored(scene, state, *technique_, map_, target, with_need);
    } else {
        lighting_pass_.draw_lit(scene, state, *technique_, map_, target, with_need);
    }
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
