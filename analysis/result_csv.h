// What the report's figures and tables show, as CSV: for plots of one's own, and for other programs.
#pragma once

#include <string>
#include <vector>

#include "analysis/law_fit.h"
#include "analysis/reference_points.h"
#include "analysis/study_check.h"

namespace stairstep {

/// One row a threshold: observer, pattern, contrast, kernel, texel_px, radius_px, radius_low_px, radius_high_px (95 % credible),
/// trials, bounded (1 or 0: those that aren't are left out of the law).
std::string thresholds_csv(const LawFit& fit);

/// One row a condition: pattern, contrast, kernel, slope, slope_low, slope_high, tau_ln, intercept_px, intercept_low_px,
/// intercept_high_px, exponent, exponent_low, exponent_high (these six empty where they can't be estimated), observers, trials.
std::string law_csv(const Law& law);

/// One row a point: pattern, contrast, kernel, texel_px, reference_radius_px (empty where it isn't reached).
std::string reference_points_csv(const std::vector<ReferencePoint>& points);

/// One row an observer and condition, then one of all together (observer and condition empty): observer, pattern, contrast, kernel,
/// texel_px, task, artifacts, hits, lines, false_alarms, d_prime, d_prime_low, d_prime_high, criterion, criterion_low,
/// criterion_high (these six empty where one of the two was never shown).
std::string sensitivity_csv(const std::vector<Trial>& trials);

/// One row a condition of StudyCheck: pattern, contrast, kernel, curves, steepness, lapse, lapse_low, lapse_high, deviance_p, prediction_p,
/// order_p, scatter_chi2, scatter_df, scatter_p, overdispersion; empty where there is no number.
std::string checks_csv(const StudyCheck& check);

/// One row a pair: first_pattern, first_contrast, second_pattern, second_contrast, kernel, ratio, ratio_low, ratio_high, p, p_holm,
/// observers.
std::string comparisons_csv(const Law& law);

/// One row a criterion: threshold_probability, slope, slope_low, slope_high, texels_across, texels_in_all.
std::string criteria_csv(const Law& law);

/// One row a condition and method, and one for the robust fit: pattern, contrast, kernel, method, slope, slope_low, slope_high.
std::string estimates_csv(const Law& law, const Law& robust);

}  // namespace stairstep
