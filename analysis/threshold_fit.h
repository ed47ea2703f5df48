// Thresholds from raw trials: for each observer and condition, the radius at which answers are right with
// probability p_T.
//
// The posterior of T on a grid over T, steepness β and lapse rate δ, summed over β and δ: an adaptive track says little
// about them, and a wrong fixed β makes intervals too narrow. γ = ½: lines are shown on half the trials and answers
// counted as right or wrong. T has a flat prior over what the track could tell, ln β is normal around ln 3.5 with SD 0.4,
// and δ is exponential with mean 0.03.
#pragma once

#include <string>
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

    /// Radius at threshold, px.
    double radius_px() const;
    /// Standard deviation of ln(radius).
    double ln_radius_sd() const;
};

/// p_threshold in (0.55, 0.9): above guessing, below what a lapsing observer reaches. The track must have a trial.
Threshold fit_threshold(const Track& track, double p_threshold);

}  // namespace stairstep
