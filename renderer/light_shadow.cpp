#include "renderer/light_shadow.h"

#include <algorithm>
#include <cmath>

#include "stimuli/error.h"

namespace stairstep {
namespace {

/// Across the longer side, of a map whose need isn't known yet.
constexpr double kFirstGuessTexels = 512;

/// Half-width of the constant filter in the light plane.
double light_plane_radius(double radius, const Light& light, const glm::dvec3& middle) {
    if (light.kind == Light::Kind::directional) return radius;
    return radius / std::max(depth_along(light, middle), 1e-9);
}

/// Texels beyond its radius that a filter may look at: the one that its rim touches, and half of one that its own is at least.
constexpr double kMarginTexels = 2;

TechniqueSettings technique_settings(const ShadowSettings& settings) {
    TechniqueSettings technique = settings.technique;
    technique.skip_even_texels = settings.skips.even_texels;
    return technique;
}

}  // namespace

LightShadow::LightShadow(const TechniqueEntry& entry, const ShadowSettings& settings, const GpuScene& scene,
                         const SceneState& first, double aspect, const glm::dvec3& middle)
    : settings_(settings), middle_(middle) {
    // A filter mode that is chosen by the map needs the first; a technique to say how far it looks isn't there yet.
    map_.filter_radius = light_plane_radius(settings.radius, first.light, middle_);
    const LightFrustum frustum = fit_light_frustum(
        scene.extents, first, aspect, settings.fit, [&](auto&) { return map_.filter_radius; }, settings.warp,
        settings.depth);
    map_.shape =
        settings.fixed_size
            ? map_of_size(frustum, *settings.fixed_size)
            : map_by_law(frustum, {settings.technique.law_slope, map_.filter_radius, 0, 0, settings.largest_size});
    technique_ = entry.make(technique_settings(settings), map_, !settings.fixed_size);
    if (settings.warp != Warp::none && !technique_->takes_warp()) {
        throw InputError("--warp lispsm", std::string(entry.name) + " filters texels that are all of one size",
                         "use hard or pcf, or --warp none");
    }
    if (settings.depth.spot == SpotDepth::linear && technique_->reads_map() && !technique_->takes_linear_depth()) {
        throw InputError(
            "--spot-depth linear",
            std::string(entry.name) + " compares depths over a filter by a plane, which only the reciprocal keeps",
            "use hard or pcf, or --spot-depth reciprocal");
    }
    reserve(settings.fixed_size.value_or(capacity_for(1, settings.largest_size)));
    if (!settings.fixed_size && technique_->measures_need()) meter_.emplace();
}

LightFrustum LightShadow::fit(const GpuScene& scene, const SceneState& state, double aspect, double margin) const {
    const double filter_radius = light_plane_radius(settings_.radius, state.light, middle_);
    return fit_light_frustum(
        scene.extents, state, aspect, settings_.fit,
        [&](const LightFrustum& unfitted) { return technique_->reach(unfitted, filter_radius) + margin; },
        settings_.warp, settings_.depth);
}

glm::dvec2 LightShadow::shadowed_range(const GpuScene& scene, const SceneState& state, double aspect) const {
    // A texel that a filter touches reaches beyond the caster at its middle.
    const double texel = light_plane_radius(settings_.radius, state.light, middle_) / settings_.technique.law_slope;
    const Camera& camera = state.camera;
    const glm::dvec2 range = glm::clamp(fit(scene, state, aspect, texel).view_range, camera.near, camera.far);
    return range.x < range.y ? range : glm::dvec2(camera.near, camera.far);
}

void LightShadow::reserve(int capacity) {
    ShadowMap map = technique_->reserve(capacity, settings_.depth.format);
    map.shape = map_.shape;
    map.filter_radius = map_.filter_radius;
    map_ = std::move(map);
}

ShadowMapShape LightShadow::choose(const GpuScene& scene, const SceneState& state, double aspect, int height_px,
                                   bool again) {
    if (!again) was_settled_ = choice_.texel > 0;
    const LightFrustum frustum = fit(scene, state, aspect, 0);
    if (settings_.fixed_size) return map_of_size(frustum, *settings_.fixed_size);
    const int largest = settings_.largest_size;
    if (meter_) {
        if (!(again && was_settled_)) {
            if (const std::optional<TileNeeds> needs = meter_->take())
                last_need_ = needed_texel(*needs, settings_.statistic);
            // A frame whose pixels are known already needs what it needed.
            if (last_need_) choice_ = choose_texel(choice_, *last_need_, settings_.patience);
        }
        const double longest = std::max(frustum.extent().x, frustum.extent().y);
        const double texel = choice_.texel > 0 ? choice_.texel : texel_on_ladder(longest / kFirstGuessTexels);
        return map_of_texels(frustum, texel, largest, ShadowMapShape::Limit::law);
    }
    // What a pixel covers where shadows are nearest; in the light plane it can only look smaller.
    double pixel = 0;
    if (std::isfinite(frustum.view_range.x)) {
        pixel = pixel_footprint(state.camera, std::max(frustum.view_range.x, state.camera.near), height_px);
        if (frustum.kind == Light::Kind::spot) pixel /= frustum.farthest;
    }
    const double filter_radius = light_plane_radius(settings_.radius, state.light, middle_);
    return map_by_law(frustum, {settings_.technique.law_slope, filter_radius, 0, pixel, largest});
}

std::optional<ShadowQuestion> LightShadow::question(const ShadowMapShape& shape, const SceneState& state,
                                                    const LightPart& part) {
    const Skips& skips = settings_.skips;
    const LightFrustum& frustum = shape.frustum;
    if (!skips.hidden_shadows || !technique_->reads_map()) return std::nullopt;
    if (skips.unseen_shadows && frustum.shadowless) return std::nullopt;
    if (!query_patience_.is_due()) return std::nullopt;
    ShadowQuestion question{.light = state.light, .frustum = frustum, .slice = part.slice};
    // A prefiltered map is looked at through its mipmaps, a warped one through texels of many sizes.
    question.looks_anywhere = frustum.warp.warps() || technique_->lookups(map_).prefiltered;
    question.reach = kMarginTexels * std::max(shape.texel().x, shape.texel().y);
    if (technique_->measures_need()) {
        // Of the disk over the box, and of the texels that a level of the map may be coarser by.
        const double beyond = 1.2 + 0.5 / settings_.technique.law_slope;
        question.softness =
            beyond * (state.light.kind == Light::Kind::spot ? state.light.half_side : state.light.half_tangent());
    } else {
        question.reach += technique_->reach(frustum, light_plane_radius(settings_.radius, state.light, middle_));
    }
    return question;
}

void LightShadow::update_map(const ShadowMapShape& shape, Shown shown, const GpuScene& scene, const SceneState& state,
                             gl::PassTimer& timer, FrameTime& time) {
    const int side = std::max(shape.width, shape.height);
    if (side > map_.capacity) reserve(capacity_for(side, std::max(side, settings_.largest_size)));
    map_.shape = shape;
    map_.filter_radius = light_plane_radius(settings_.radius, state.light, middle_);
    const Skips& skips = settings_.skips;
    if (!technique_->reads_map() || shown != Shown::shadow) return;
    gl::ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    timer.start();
    const bool drawn =
        keeper_.update(scene, state, map_, {skips.unseen_triangles, skips.unchanged_maps, !skips.back_faces});
    time.depth += timer.stop();
    if (!drawn) return;
    timer.start();
    technique_->prepare(map_);
    time.prepare += timer.stop();
}

bool LightShadow::Seen::same_as(const Seen& other) const {
    return scene == other.scene && target == other.target && camera == other.camera && light == other.light &&
           movers == other.movers && shape.texels_equal(other.shape);
}

LightShadow::Seen LightShadow::seen_in(const GpuScene& scene, const SceneState& state, const FrameTarget& target,
                                       const ShadowMapShape& shape) {
    return {scene.serial, target.serial, state.camera, state.light, state.movers, shape};
}

bool LightShadow::repeats(Shown shown, const ShadowMapShape& shape, const GpuScene& scene, const SceneState& state,
                          const FrameTarget& target) const {
    return keeps() && shown == Shown::shadow && seen_ && seen_->same_as(seen_in(scene, state, target, shape));
}

void LightShadow::keep(const Seen& seen, bool stored, const FrameTarget& target, LightPart& part) {
    const bool same = seen_ && seen_->same_as(seen);
    seen_ = seen;
    if (!same) kept_is_filled_ = false;
    // Surfaces that are lit as they are drawn are covered by others.
    if (!stored) return;
    if (kept_is_filled_) {
        part.visibility = LightPart::Visibility::kept;
        part.kept = kept_.id();
        part.need = false;
        return;
    }
    if (!same) return;
    if (kept_of_target_ != target.serial) {
        kept_ = gl::make_texture(GL_R32F, target.width, target.height);
        kept_framebuffer_ = gl::make_framebuffer({target.colour.id(), target.need.id(), kept_.id()}, target.depth.id());
        kept_of_target_ = target.serial;
    }
    part.framebuffer = kept_framebuffer_.id();
    kept_is_filled_ = true;
}

void LightShadow::light(Shown shown, const GpuScene& scene, const SceneState& state, const DrawList& surfaces,
                        bool stored, const FrameTarget& target, LightPart part, LightingPass& pass,
                        gl::PassTimer& timer, FrameTime& time) {
    gl::ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    part.need = meter_ && target.samples == 1;
    if (shown != Shown::shadow) {
        part.visibility = LightPart::Visibility::all_lit;
        // No pixel needs a texel. What comes after isn't the same as what was before.
        if (part.need) last_need_ = INFINITY;
        part.need = measured_ = false;
        seen_.reset();
        kept_is_filled_ = false;
        // The first light brings the sky.
        if (shown == Shown::nothing && part.index > 0) return;
    } else if (keeps()) {
        keep(seen_in(scene, state, target, map_.shape), stored, target, part);
    }
    measured_ = part.need;
    timer.start();
    if (stored) {
        pass.light_stored(scene, state, *technique_, map_, target, part);
    } else {
        pass.draw_lit(scene, state, surfaces, *technique_, map_, target, part);
    }
    time.lighting += timer.stop();
    if (!part.need) return;
    timer.start();
    meter_->measure(target);
    time.need += timer.stop();
}

}  // namespace stairstep
