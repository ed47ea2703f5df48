#include "renderer/bench/scene_truth.h"

#include "renderer/gl/context.h"
#include "renderer/techniques/techniques.h"
#include "renderer/truth/truth_cache.h"
#include "stimuli/number.h"

namespace stairstep::bench {

std::string describe(TruthKind kind, const TruthSettings& settings) {
    if (kind == TruthKind::area_light) return std::to_string(settings.light_samples) + " rays a pixel";
    const std::string side = std::to_string(settings.filter_side);
    return std::to_string(settings.filter_taps) + " taps over " + side + " x " + side + " texels";
}

SceneTruth::SceneTruth(const Scene& scene, const GpuScene& gpu_scene, double radius, const TruthSettings& settings,
                       int width, int height)
    : scene_(scene), gpu_scene_(gpu_scene), radius_(radius), settings_(settings), width_(width), height_(height) {}

std::vector<float> SceneTruth::draw_filter(TruthKind kind, const SceneState& state) {
    std::optional<ShadowRenderer>& renderer = converged_[static_cast<size_t>(kind)];
    if (!target_) target_.emplace(make_frame_target(Show::visibility, width_, height_, 1));
    if (!renderer) {
        ShadowSettings settings;
        settings.technique.filter = kind == TruthKind::box_filter ? FilterMode::jittered : FilterMode::rotated;
        settings.technique.filter_taps = settings_.filter_taps;
        settings.radius = radius_;
        settings.fixed_size = settings_.filter_side;
        renderer.emplace(technique_named("pcf"), settings, gpu_scene_, state, static_cast<double>(width_) / height_);
    }
    gl::PassTimer timer;
    renderer->draw(gpu_scene_, state, *target_, timer);
    return read_visibility(*target_);
}

std::vector<float> SceneTruth::visibility(TruthKind kind, const SceneState& state) {
    if (kind == TruthKind::area_light) {
        return cached_area_light_visibility(scene_, state, width_, height_, settings_.light_samples, settings_.cache,
                                            settings_.jobs);
    }
    const std::string key = truth_key(scene_, state, width_, height_, settings_.filter_taps) + "-" +
                            std::string(name(kind)) + "-" + std::to_string(settings_.filter_side) + "-" +
                            format_number(radius_);
    const std::string description =
        "stairstep-filter/" + std::to_string(kFilterTruthVersion) + " " + key + " " + gl::renderer_name();
    return cached_visibility(settings_.cache / ("filter-" + key + ".exr"), description, width_, height_,
                             [&] { return draw_filter(kind, state); });
}

}  // namespace stairstep::bench
