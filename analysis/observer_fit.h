// One observer's law in one pattern, contrast and kernel.
//
// Ceres fits r = c·a to the thresholds r_i at texel sizes a_i, in logarithms, each weighted by its own uncertainty: residual
// (ln(c·a_i) − ln r_i)/s_i. The same with an intercept, r = b + c·a, and with an exponent, r = c·a^p. Residuals are in standard
// deviations that the thresholds state, so standard errors are those of the inverse of JᵀJ, here in closed form for one or two
// parameters; they aren't scaled by the residuals' own variance, of which a few sizes say nothing (the spread between observers
// takes up what they leave out).
//
// A robust fit has Huber's loss with the bound 1.345 SD: a threshold z > 1.345 SD off counts 1.345/z.
//
// Anchor: without it, ln c is the mean of ln(r_i/a_i) with weights 1/s_i², its standard error 1/√Σ 1/s_i².
#pragma once

#include <optional>
#include <vector>

#include "analysis/law/law.h"
#include "analysis/law/law_statistics.h"
#include "analysis/random_effects.h"
#include "analysis/threshold_fit.h"

namespace stairstep {

/// A law with one more free parameter than the slope, and that parameter's standard error.
struct ObserverForm {
    LawParameters<double> parameters;
    double se = 0;
};

struct ObserverLaw {
    LawParameters<double> through_origin;
    /// Standard error of ln c.
    double ln_slope_se = 0;
    /// c by weighted least squares of r = c·a in pixels; a threshold's standard deviation there is in proportion to a.
    double linear_slope = 0;
    /// None with fewer than two texel sizes, or where Ceres doesn't converge.
    std::optional<ObserverForm> with_intercept;
    std::optional<ObserverForm> with_exponent;
    /// One a threshold, in (0, 1]: what the robust loss left of it in the fit through the origin.
    std::vector<double> weight;

    /// ln c and its standard error.
    Effect ln_slope() const;
};

/// nullopt for no threshold, and where Ceres doesn't converge. All thresholds are one observer's in one pattern, contrast and
/// kernel; a size may occur twice.
std::optional<ObserverLaw> fit_observer(const std::vector<Threshold>& thresholds, bool robust = false);

/// `fit_observer`'s ln c alone, in the closed form above unless it is robust: for the many studies of a simulation.
std::optional<Effect> fit_ln_slope(const std::vector<Threshold>& thresholds, bool robust = false);

/// What a condition's slope is made of (slope_estimate.h), in closed form: the same as `fit_observer`'s, without its other
/// laws. nullopt for no threshold.
std::optional<ObserverSlope> observer_slope(const std::vector<Threshold>& thresholds);

/// c by weighted least squares of r = c·a in pixels, as ObserverLaw has it. At least one threshold (asserted).
double linear_slope(const std::vector<Threshold>& thresholds);

}  // namespace stairstep
