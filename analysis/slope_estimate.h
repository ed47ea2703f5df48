// A condition's slope c by a choice of methods, each saying in words what it did.
//
// | name             | value                     | 95 % interval                                                        |
// | sandwich         | exp of REML mean of ln c  | sandwich error, Satterthwaite's t (random_effects.h): the default    |
// | knapp-hartung    | exp of REML mean of ln c  | Knapp-Hartung t                                                      |
// | mean-t           | exp of plain mean of ln c | Student's t                                                          |
// | linear-t         | plain mean of c in pixels | Student's t; the mean of c, e^{τ²/2} times its median                |
// | profile          | exp of ML mean            | profile likelihood, its bound exact for equal errors                 |
// | posterior        | posterior median          | equal-tailed; τ half-Cauchy with scale .3                            |
// | parametric       | exp of REML mean          | studentised bootstrap of observers' slopes, simulated from the fit   |
// | thresholds       | exp of REML mean          | the same, each threshold simulated and each observer's law fitted    |
// | bca              | exp of REML mean          | observers resampled, bias-corrected and accelerated                  |
//
// The first six need no replicates. A robust fit has two: sandwich means Huber's mean with its sandwich t (robust_mean.h), bca
// resamples Huber's mean.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "analysis/bootstrap.h"
#include "analysis/law/law_statistics.h"
#include "analysis/threshold_fit.h"

namespace stairstep {

enum class SlopeMethod { sandwich, knapp_hartung, mean_t, linear_t, profile, posterior, parametric, thresholds, bca };

constexpr SlopeMethod kSlopeMethods[]{SlopeMethod::sandwich,   SlopeMethod::knapp_hartung, SlopeMethod::mean_t,
                                      SlopeMethod::linear_t,   SlopeMethod::profile,       SlopeMethod::posterior,
                                      SlopeMethod::parametric, SlopeMethod::thresholds,    SlopeMethod::bca};

/// As in the table above.
std::string_view name(SlopeMethod method);
std::optional<SlopeMethod> slope_method_named(std::string_view name);

/// Whether it draws replicates.
bool needs_bootstrap(SlopeMethod method);

/// Whether a robust fit has it.
bool has_robust_form(SlopeMethod method);

/// Median of the prior of τ, in ln units: observers' slopes by a factor of e^.3 apart are neither expected nor excluded.
constexpr double kTauPriorScale = 0.3;

/// What a slope is estimated from.
struct SlopeData {
    /// Two or more.
    std::vector<ObserverSlope> observers;
    /// Their thresholds, in the same order; needed by SlopeMethod::thresholds alone.
    std::vector<std::vector<Threshold>> thresholds;
    bool robust = false;
};

/// At least two observers (asserted); the interval holds the value.
SlopeEstimate slope_estimate(SlopeMethod method, const SlopeData& data, const BootstrapSettings& settings);

/// ln c without an interval, from any number of observers: the REML mean, or Huber's.
double mean_ln_slope(const std::vector<ObserverSlope>& observers, bool robust);

}  // namespace stairstep
