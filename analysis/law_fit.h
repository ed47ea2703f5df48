// From trials to the law per condition, with the observer as the unit.
//
// Thresholds (threshold_fit.h) → each observer's ln c_j and its standard error (observer_fit.h) → the condition's slope over observers
// (slope_estimate.h: random effects, REML, sandwich error unless asked otherwise) → the worst case over conditions (worst_case.h).
// Observers differ far more than trials do: pooling all points, or Ceres' covariance of a pooled fit, gives intervals that cover
// 62–84 % instead of 95 %. Intercept and exponent, r = b_j + c_j·a and r = c_j·a^{p_j}, are random-effects means over observers
// likewise: is the law a line through the origin at all?
//
// Tracks that don't bound their threshold are left out, with a warning: 2–4 % of tracks of 20 or 40 trials. That selects: keeping
// them, by their posteriors as they are, moves ln c by +.0009 ± .0002 (usual study), +.0001 ± .0003 (β 2, lapses .05) and
// −.0002 ± .0004 (20 trials a track), less than .1 %, at the same coverage (200 planted studies of 10 observers each).
#pragma once

#include <string>
#include <vector>

#include "analysis/bootstrap.h"
#include "analysis/law/law_file.h"
#include "analysis/observer_fit.h"
#include "analysis/slope_estimate.h"
#include "analysis/threshold_fit.h"

namespace stairstep {

struct LawFitOptions {
    /// What the law's slope and interval are. ConditionLaw::estimates has the others beside it.
    SlopeMethod method = SlopeMethod::sandwich;
    /// Huber's loss for thresholds within an observer, and Huber's mean over observers; goes with sandwich and bca alone.
    bool robust = false;
    /// With no replicates, `estimates` holds only what needs none.
    BootstrapSettings bootstrap{.replicates = 0};
};

/// What stands between the trials and the law.
struct LawFit {
    std::vector<Threshold> thresholds;
    Law law;
    /// What the user should know: tracks left out, conditions that could not be fitted, what a robust fit trusts less.
    std::vector<std::string> warnings;
};

/// Fits thresholds at p_threshold, then the law. `source` goes into Law::source.
/// Throws FailureError, saying what is missing, where no condition has two observers with bounded thresholds, and InputError for a
/// method that needs replicates without any, or that has no robust form where that is asked for.
LawFit fit_law(const std::vector<Trial>& trials, double p_threshold, const std::string& source,
               const LawFitOptions& options = {});

/// The same from thresholds, all at p_threshold: what simulations of studies need. Law::trials is the sum over thresholds.
LawFit fit_law_to_thresholds(std::vector<Threshold> thresholds, double p_threshold, const std::string& source,
                             const LawFitOptions& options = {});

/// The laws at several criteria beside each other, for Law::criteria: each p's worst case, and texels relative to p = .82, which is
/// fitted too where it isn't among them. Throws as `fit_law`.
std::vector<CriterionLaw> fit_criteria(const std::vector<Trial>& trials, const std::vector<double>& p_thresholds,
                                       const std::string& source, const LawFitOptions& options = {});

}  // namespace stairstep
