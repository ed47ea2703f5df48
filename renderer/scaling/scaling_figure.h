// Frame times along an axis as SVG by gnuplot: log-log, a line a technique with its exponent in the key.
#pragma once

#include <string>

#include "renderer/scaling/curves.h"

namespace stairstep::scaling {

/// Measured points, and through them the fitted power laws, dashed. Filled markers are of maps that the law sized. Throws
/// FailureError where gnuplot can't draw.
std::string scaling_figure(const AxisCurves& axis);

}  // namespace stairstep::scaling
