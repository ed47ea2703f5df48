#include "analysis/threshold_fit.h"

#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "analysis/threshold_posterior.h"

namespace stairstep {
namespace {

/// Share of the posterior at an end of T's range from which on T counts as not bounded there.
constexpr double kEndShare = 0.01;

}  // namespace

std::vector<Track> tracks_of(const std::vector<Trial>& trials) {
    std::vector<Track> tracks;
    std::map<std::tuple<std::string, Pattern, KernelShape, double, double>, size_t> index;
    for (const Trial& trial : trials) {
        const Condition& c = trial.condition;
        const auto [place, is_new] =
            index.try_emplace({trial.observer, c.pattern, c.kernel, c.contrast, c.texel_px}, tracks.size());
        if (is_new) tracks.push_back({trial.observer, c, {}});
        tracks[place->second].trials.push_back(trial);
    }
    return tracks;
}

double Threshold::radius_px() const {
    return condition.texel_px * std::pow(10.0, -log_threshold);
}

double Threshold::ln_radius_sd() const {
    return log_threshold_sd * std::numbers::ln10;
}

Threshold fit_threshold(const Track& track, double p_threshold, Answers answers) {
    assert(!track.trials.empty() && p_threshold >= 0.55 && p_threshold <= 0.9);
    std::vector<PooledTrials> trials;
    trials.reserve(track.trials.size());
    for (const Trial& trial : track.trials) {
        const double strength = std::log10(track.condition.texel_px / trial.radius_px);
        assert(std::isfinite(strength));
        trials.push_back({strength, trial.correct(), 1});
    }
    PosteriorSettings settings;
    settings.p_threshold = p_threshold;
    settings.overdispersed = answers == Answers::overdispersed;
    const ThresholdPosterior posterior = threshold_posterior(pool(std::move(trials)), settings);

    Threshold threshold;
    threshold.observer = track.observer;
    threshold.condition = track.condition;
    threshold.log_threshold = posterior.mean;
    threshold.log_threshold_sd = posterior.sd;
    threshold.log_threshold_ci95 = posterior.ci95;
    threshold.overdispersion = posterior.overdispersion;
    threshold.trials = static_cast<int>(track.trials.size());
    threshold.bounded = posterior.low_end_share < kEndShare && posterior.high_end_share < kEndShare;
    return threshold;
}

}  // namespace stairstep
