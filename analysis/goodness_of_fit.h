// Does a fitted psychometric function describe its trials? Deviance, drift, and single trials that carry the result.
//
// With a few answers a strength the deviance is not χ² distributed, so its reference comes from simulation (Wichmann & Hill
// 2001): as many answers at the same strengths, drawn from the fitted function and fitted again. The same simulations give
// the reference of two correlations of the residuals: with the prediction (wrong sigmoid, wrong asymptotes) and with the
// trials' order (learning, tiring).
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/psychometric_fit.h"

namespace stairstep {

struct SimulatedReference {
    double observed = 0;
    /// Share of simulations as far out as the observed value or farther, (1 + their number)/(1 + all): on the upper side for
    /// the deviance, on either side for correlations.
    double p_value = 1;
};

struct InfluentialTrial {
    /// In the answers given.
    size_t index = 0;
    /// By how much the threshold and the deviance move when this trial is left out and the rest fitted again.
    double threshold_shift = 0;
    double deviance_drop = 0;
};

struct GoodnessOfFit {
    SimulatedReference deviance;
    /// Of the deviance residuals of strengths with their predictions; of answers with their order. 0 where nothing varies.
    SimulatedReference residual_with_prediction;
    SimulatedReference residual_with_order;
    /// Simulations that could be fitted; those where all answers came out alike could not.
    int simulations = 0;
    /// Trials without which the threshold would move by half its standard error or more, or the deviance fall by more than 10.83
    /// (χ² with one degree of freedom, .999); by how far the threshold moves, largest first. One Newton step says which trials
    /// are worth a fit without them.
    std::vector<InfluentialTrial> influential;
};

/// `answers` in the order they were given, the same that `fit` is of. Throws InputError where fit.estimated is false.
/// Same seed, same result. About 1 ms a simulation.
GoodnessOfFit check_fit(const PsychometricFit& fit, const std::vector<Answer01>& answers, int simulations,
                        uint64_t seed);

/// First estimate of what leaving an answer out does to the threshold: one Newton step, −(I⁻¹·score). 0 without a covariance.
double one_step_threshold_shift(const PsychometricFit& fit, const Answer01& answer);

/// Pearson's; 0 where either doesn't vary. Of equally many numbers (asserted).
double correlation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace stairstep
