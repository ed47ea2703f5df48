// Thresholds from raw trials: for each observer and condition, the radius at which answers are right with
// probability p_T.
//
// The posterior of T, summed over steepness β and lapse rate δ: an adaptive track says little about them, and a wrong fixed
// β makes intervals too narrow. γ = ½: lines are shown on half the trials and answers counted as right or wrong. T has a
// flat prior over what the track could tell; those of β and δ are threshold_posterior.h's.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/trial.h"

namespace stairstep {

/// The trials of one observer in one condition, in order.
struct Track {
    std::string observer;
    Condition condition;
    std::vector<Trial> trials;
};

/// Groups trials by observer and condition, in the order of their first trial.
std::vector<Track> tracks_of(const std::vector<Trial>& trials);

struct Threshold {
    std::string observer;
    Condition condition;
    /// T = log10(texel_px/radius_px) at p_T: posterior mean and standard deviation.
    double log_threshold = 0;
    double log_threshold_sd = 0;
    int trials = 0;
    /// Whether the trials bound T on both sides; if not, the estimate says where the prior ends, not where T is.
    bool bounded = true;
    /// 95 % credible interval of T: its posterior's quantiles .025 and .975.
    std::pair<double, double> log_threshold_ci95;
    /// Posterior mean of η, see overdispersion.h; 0 where it was not asked for.
    double overdispersion = 0;

    /// Radius at threshold, px.
    double radius_px() const;
    /// Standard deviation of ln(radius).
    double ln_radius_sd() const;
};

/// Whether answers at the same strength may go together more than independent ones (blocked data alone can tell).
enum class Answers { independent, overdispersed };

/// p_threshold in [0.55, 0.9]: above guessing, below what a lapsing observer reaches. The track must have a trial, and
/// sizes and radii are positive and finite (all asserted).
Threshold fit_threshold(const Track& track, double p_threshold, Answers answers = Answers::independent);

}  // namespace stairstep
