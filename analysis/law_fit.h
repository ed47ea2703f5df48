// The law per condition, with the observer as the unit.
//
// For each observer j Ceres fits r = c_j·a to the thresholds r_ij at texel sizes a_i, in logarithms, each weighted by
// its own uncertainty: residual (ln c_j·a_i − ln r_ij)/s_ij. The condition's slope is the mean of ln c_j over observers,
// its interval mean ± t_{n−1}·sd/√n: observers differ far more than trials do, and pooling all points, or Ceres'
// covariance of a pooled fit, gives intervals that cover 62–84 % instead of 95 %.
// The same is done with an intercept, r = b_j + c_j·a, and with an exponent, r = c_j·a^{p_j}: is the law a line
// through the origin at all?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/law/law.h"
#include "analysis/law/law_file.h"
#include "analysis/threshold_fit.h"

namespace stairstep {

/// What stands between the trials and the law.
struct LawFit {
    std::vector<Threshold> thresholds;
    Law law;
    /// What the user should know: tracks left out, conditions that could not be fitted.
    std::vector<std::string> warnings;
};

/// Fits thresholds at p_threshold, then the law. `source` goes into Law::source.
/// Throws FailureError where no condition has two observers with bounded thresholds at two texel sizes each.
LawFit fit_law(const std::vector<Trial>& trials, double p_threshold, const std::string& source);

/// One observer's parameters: slope alone; with an intercept; with an exponent. nullopt where Ceres doesn't converge.
/// The thresholds are one observer's in one pattern × contrast × kernel, at two or more texel sizes.
struct ObserverLaw {
    LawParameters<double> through_origin;
    LawParameters<double> with_intercept;
    LawParameters<double> with_exponent;
};
std::optional<ObserverLaw> fit_observer(const std::vector<Threshold>& thresholds);

}  // namespace stairstep
