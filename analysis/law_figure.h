// The law as a figure: filter radius against texel size, observers' thresholds beside the reference filter size.
#pragma once

#include <string>
#include <vector>

#include "analysis/law_fit.h"
#include "analysis/reference_points.h"

namespace stairstep {

/// SVG. A column a contrast. On top, on even axes: thresholds of observers, geometric means with 95 % intervals, laws r = c·a
/// with their bands. Below, on logarithmic axes, where r = c·a has slope 1 whatever c: means and laws again, and the reference
/// filter sizes. Throws FailureError where gnuplot can't draw.
std::string law_figure(const LawFit& fit, const std::vector<ReferencePoint>& references);

}  // namespace stairstep
