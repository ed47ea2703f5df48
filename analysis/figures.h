// The report's figures, as SVG.
#pragma once

#include <string>
#include <vector>

#include "analysis/law_fit.h"

namespace stairstep {

/// Radius at threshold against texel size, a panel a contrast: observers' thresholds, their geometric mean with its 95 %
/// interval at each size, and the fitted law with its band (Kreuzer 2017, figure 4.6).
std::string law_figure(const LawFit& fit);

/// How tracks converged: radius shown against trial number, right and wrong answers apart, and the fitted threshold
/// with ± 1.96 SD. The tracks of the first observer's first pattern and contrast, one panel each.
std::string convergence_figure(const std::vector<Trial>& trials, const LawFit& fit);

}  // namespace stairstep
