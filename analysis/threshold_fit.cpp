#include "analysis/threshold_fit.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "study/psychometric.h"

namespace stairstep {
namespace {

constexpr std::array kBetas{1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0};
constexpr std::array kDeltas{0.0, 0.01, 0.02, 0.035, 0.055, 0.08};
constexpr double kGamma = 0.5;
constexpr double kGrain = 0.02;
/// How far beyond the strengths shown T may lie, log10 units.
constexpr double kMargin = 0.8;
/// Share of the posterior at an end of the grid from which on T counts as not bounded there.
constexpr double kEndShare = 0.01;

double log_prior(double beta, double delta) {
    const double z = std::log(beta / 3.5) / 0.4;
    return -z * z / 2 - delta / 0.03;
}

}  // namespace

std::vector<Track> tracks_of(const std::vector<Trial>& trials) {
    std::vector<Track> tracks;
    for (const Trial& trial : trials) {
        auto track = std::find_if(tracks.rbegin(), tracks.rend(), [&](const Track& t) {
            return t.observer == trial.observer && t.condition == trial.condition;
        });
        if (track == tracks.rend()) {
            tracks.push_back({trial.observer, trial.condition, {}});
            track = tracks.rbegin();
        }
        track->trials.push_back(trial);
    }
    return tracks;
}

double Threshold::radius_px() const {
    return condition.texel_px * std::pow(10.0, -log_threshold);
}

double Threshold::ln_radius_sd() const {
    return log_threshold_sd * std::numbers::ln10;
}

Threshold fit_threshold(const Track& track, double p_threshold) {
    assert(!track.trials.empty());
    std::vector<double> strengths;
    for (const Trial& trial : track.trials) strengths.push_back(std::log10(track.condition.texel_px / trial.radius_px));
    const auto [weakest, strongest] = std::minmax_element(strengths.begin(), strengths.end());
    const double first = *weakest - kMargin;
    const size_t count = static_cast<size_t>((*strongest + kMargin - first) / kGrain) + 1;

    // Log posterior of every (β, δ, T), then summed over β and δ.
    std::vector<double> joint;
    joint.reserve(kBetas.size() * kDeltas.size() * count);
    for (const double beta : kBetas) {
        for (const double delta : kDeltas) {
            const PsychometricShape shape{beta, kGamma, delta, p_threshold};
            const double offset = threshold_offset(shape);
            for (size_t i = 0; i < count; ++i) {
                double log_posterior = log_prior(beta, delta);
                for (size_t k = 0; k < strengths.size(); ++k) {
                    log_posterior +=
                        log_likelihood(shape, offset, strengths[k], first + i * kGrain, track.trials[k].correct());
                }
                joint.push_back(log_posterior);
            }
        }
    }
    const double largest = *std::max_element(joint.begin(), joint.end());
    std::vector<double> marginal(count);
    for (size_t j = 0; j < joint.size(); ++j) marginal[j % count] += std::exp(joint[j] - largest);

    double mass = 0;
    double moment = 0;
    for (size_t i = 0; i < count; ++i) {
        mass += marginal[i];
        moment += marginal[i] * (first + i * kGrain);
    }
    const double mean = moment / mass;
    double spread = 0;
    for (size_t i = 0; i < count; ++i) {
        const double deviation = first + i * kGrain - mean;
        spread += marginal[i] * deviation * deviation;
    }

    // Ends of 0.1 log10 units: what a bounded posterior has left behind by then.
    const size_t end = std::min(count, static_cast<size_t>(0.1 / kGrain));
    double low_end = 0;
    double high_end = 0;
    for (size_t i = 0; i < end; ++i) {
        low_end += marginal[i];
        high_end += marginal[count - 1 - i];
    }
    return {track.observer, track.condition, mean,
            // The grid resolves no less than the deviation within one of its cells.
            std::max(std::sqrt(spread / mass), kGrain / std::sqrt(12.0)), static_cast<int>(track.trials.size()),
            low_end < kEndShare * mass && high_end < kEndShare * mass};
}

}  // namespace stairstep
