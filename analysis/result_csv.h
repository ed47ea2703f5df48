// What the report's figures and tables show, as CSV: for plots of one's own, and for other programs.
#pragma once

#include <string>

#include "analysis/law_fit.h"

namespace stairstep {

/// One row a threshold: observer, pattern, contrast, kernel, texel_px, radius_px, radius_low_px, radius_high_px (95 % credible),
/// trials, bounded (1 or 0: those that aren't are left out of the law).
std::string thresholds_csv(const LawFit& fit);

/// One row a condition: pattern, contrast, kernel, slope, slope_low, slope_high, tau_ln, intercept_px, intercept_low_px,
/// intercept_high_px, exponent, exponent_low, exponent_high (these six empty where they can't be estimated), observers, trials.
std::string law_csv(const Law& law);

}  // namespace stairstep
