#include "renderer/bench/measurement.h"

#include <algorithm>
#include <cassert>
#include <deque>
#include <memory>

#include "renderer/bench/frontier.h"
#include "renderer/frame_median.h"
#include "renderer/techniques/techniques.h"
#include "stimuli/number.h"

namespace stairstep::bench {
namespace {

/// A new renderer meets its first frame's needs at once; this many frames without a change show that it has, and so many are
/// waited for at most.
constexpr int kSettledFrames = 4;
constexpr int kMostSettlingFrames = 40;

double aspect_of(const MeasurementSettings& settings) {
    return static_cast<double>(settings.width) / settings.height;
}

ShadowRenderer make_renderer(const Configuration& configuration, const MeasurementSettings& settings,
                             const Subject& subject) {
    ShadowSettings shadow;
    shadow.technique.filter = configuration.filter;
    shadow.technique.law_slope = settings.law_slope;
    if (configuration.taps > 0) shadow.technique.filter_taps = shadow.technique.search_taps = configuration.taps;
    shadow.radius = subject.radius;
    shadow.fixed_size = configuration.side;
    shadow.warp = configuration.warp;
    shadow.skips = skips_without(configuration.no_skip);
    shadow.largest_size = settings.largest_size;
    return ShadowRenderer(technique_named(configuration.entry), shadow, subject.scene, subject.state,
                          aspect_of(settings));
}

void draw_until_settled(ShadowRenderer& renderer, const Subject& subject, const FrameTarget& target, bool by_need) {
    gl::PassTimer timer;
    int settled = 0;
    for (int i = 0; i < kMostSettlingFrames && settled < kSettledFrames; ++i) {
        const glm::dvec2 texel = renderer.map().shape.texel();
        renderer.draw(subject.scene, subject.state, target, timer);
        settled = renderer.map().shape.texel() == texel ? settled + 1 : 0;
        // All but the maps that follow what pixels need have their size from the first frame.
        if (!by_need) break;
    }
}

bool follows_need(const Configuration& configuration, const ShadowRenderer& renderer) {
    return !configuration.side && renderer.technique().measures_need();
}

void set_error(Measurement& measurement, const std::vector<float>& truth, const FrameTarget& target) {
    measurement.error = compare_visibility(measurement.visibility, truth);
    measurement.rmse_levels = compare_pictures(visibility_picture(measurement.visibility, target.width, target.height),
                                               visibility_picture(truth, target.width, target.height))
                                  .rmse_levels;
}

bool is_shown(const Configuration& configuration) {
    return configuration == auto_pcf() || configuration == fixed_pcf() || configuration == auto_pcss() ||
           configuration == fixed_pcss();
}

Measurement measurement_of(TimedRenderer& timed, const std::vector<TimedRenderer>& group, const FrameTarget& target) {
    Measurement measurement;
    static_cast<MedianTimes&>(measurement) = median_times(timed);
    measurement.configuration = timed.configuration;
    const auto baseline = std::ranges::find(group, baseline_of(timed.configuration), &TimedRenderer::configuration);
    assert(baseline != group.end());
    std::vector<double> ratios;
    for (size_t i = 0; i < timed.times.size(); ++i) {
        ratios.push_back(timed.times[i].cpu_ms() / baseline->times[i].cpu_ms());
    }
    measurement.time_ratio = median(std::move(ratios));

    gl::PassTimer timer;
    timed.renderer.draw(timed.subject.scene, timed.subject.state, target, timer);
    measurement.visibility = read_visibility(target);
    const ShadowTechnique& technique = timed.renderer.technique();
    const ShadowMap& map = timed.renderer.map();
    measurement.lookups = technique.lookups(map);
    if (technique.reads_map()) {
        measurement.width = map.shape.width;
        measurement.height = map.shape.height;
        measurement.limited_by = name(map.shape.limit);
    }
    return measurement;
}

/// `list` without what would take seconds a frame.
std::vector<Configuration> feasible(const std::vector<Configuration>& list, const MeasurementSettings& settings,
                                    const Subject& subject, const FrameTarget& target, Notes& notes) {
    const auto is_fixed_exact = [](const Configuration& one) {
        return one.entry == "pcf" && one.filter == FilterMode::exact && one.side;
    };
    if (std::ranges::none_of(list, is_fixed_exact)) return list;
    // The law's map has the same frustum as a fixed one. What the smallest texels of a map of one would be, in filter widths.
    const auto filters_across = [&](Warp warp) {
        Configuration by_law = auto_pcf();
        by_law.warp = warp;
        const ShadowRenderer renderer = settled_renderer(by_law, settings, subject, target);
        const glm::dvec2 smallest = map_of_size(renderer.map().shape.frustum, 1).smallest_texel();
        return 2 * renderer.map().filter_radius / std::min(smallest.x, smallest.y);
    };
    const double across = filters_across(Warp::none);
    const bool warps = std::ranges::any_of(list, [](const Configuration& one) { return one.warp != Warp::none; });
    const double across_warped = warps ? filters_across(Warp::lispsm) : across;
    std::vector<Configuration> result;
    for (const Configuration& one : list) {
        const double width = one.side.value_or(0) * (one.warp == Warp::none ? across : across_warped);
        if (is_fixed_exact(one) && width > kWidestExact) {
            notes.push_back(label(one) + " is left out: its filter is " + format_fixed(width, 0) + " texels wide");
        } else {
            result.push_back(one);
        }
    }
    return result;
}

}  // namespace

ShadowRenderer settled_renderer(const Configuration& configuration, const MeasurementSettings& settings,
                                const Subject& subject, const FrameTarget& target) {
    ShadowRenderer renderer = make_renderer(configuration, settings, subject);
    draw_until_settled(renderer, subject, target, follows_need(configuration, renderer));
    return renderer;
}

std::vector<Measurement> measure(const std::vector<Configuration>& list, const MeasurementSettings& settings,
                                 const Subject& subject,
                                 const std::function<const std::vector<float>&(TruthKind)>& truth, Notes& notes,
                                 const std::function<void()>& advance) {
    const FrameTarget target = make_frame_target(Show::colour, settings.width, settings.height, 1);
    const FrameTarget visibility = make_frame_target(Show::visibility, settings.width, settings.height, 1);
    const std::vector<Configuration> todo = feasible(list, settings, subject, visibility, notes);
    for (size_t left_out = todo.size(); left_out < list.size(); ++left_out) advance();
    std::vector<Measurement> done;
    for (const auto& members : groups_of(todo, settings.most_map_bytes, settings.largest_size)) {
        std::vector<TimedRenderer> group;
        // Frames that repeat find their surfaces still there, where no other has drawn since.
        std::deque<FrameTarget> own_targets;
        for (const Configuration& one : members) {
            const FrameTarget* seen_in = &target;
            if (skips_without(one.no_skip).unchanged_pixels) {
                seen_in =
                    &own_targets.emplace_back(make_frame_target(Show::colour, settings.width, settings.height, 1));
            }
            group.push_back({one, settled_renderer(one, settings, subject, *seen_in), subject, *seen_in});
        }
        time_in_turn(group, settings.frames, [] {});
        for (TimedRenderer& timed : group) {
            const bool is_wanted = std::ranges::find(todo, timed.configuration) != todo.end();
            if (!is_wanted || find(done, timed.configuration)) continue;
            done.push_back(measurement_of(timed, group, visibility));
            set_error(done.back(), truth(truth_of(timed.configuration)), visibility);
            if (!is_shown(timed.configuration)) done.back().visibility = {};
            advance();
        }
    }
    std::vector<Measurement> ordered;
    for (const Configuration& one : todo) ordered.push_back(*find(done, one));
    return ordered;
}

void find_frontiers(std::vector<Measurement>& measurements) {
    for (const bool area_light : {true, false}) {
        std::vector<size_t> places;
        std::vector<CostAndError> points;
        for (size_t i = 0; i < measurements.size(); ++i) {
            const Measurement& one = measurements[i];
            if ((truth_of(one.configuration) == TruthKind::area_light) != area_light) continue;
            if (is_ablation(one.configuration)) continue;
            places.push_back(i);
            points.push_back({steady_ms(measurements, one), one.error.rmse});
        }
        const std::vector<bool> best = on_frontier(points);
        for (size_t i = 0; i < points.size(); ++i) {
            Measurement& one = measurements[places[i]];
            one.on_frontier = best[i];
            const std::optional<size_t> dominator = dominator_of(points, i);
            one.dominator = dominator ? std::optional(places[*dominator]) : std::nullopt;
        }
    }
}

const Measurement* find(const std::vector<Measurement>& measurements, const Configuration& configuration) {
    const auto found = std::ranges::find(measurements, configuration, &Measurement::configuration);
    return found == measurements.end() ? nullptr : &*found;
}

double steady_ms(const std::vector<Measurement>& measurements, const Measurement& one) {
    const Measurement* baseline = find(measurements, baseline_of(one.configuration));
    return baseline ? one.time_ratio * baseline->frame.cpu_ms : one.frame.cpu_ms;
}

}  // namespace stairstep::bench
