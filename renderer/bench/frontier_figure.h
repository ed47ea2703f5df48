// Run time against error of a scene's configurations, as SVG by gnuplot: log-log, the Pareto frontier as steps.
#pragma once

#include <string>
#include <vector>

#include "renderer/bench/measurement.h"

namespace stairstep::bench {

/// Two panels: what is measured against the area light, and what against its own converged filter. A colour a technique, filled
/// where the law sized the map. Throws FailureError where gnuplot can't draw.
std::string frontier_figure(const std::vector<Measurement>& measurements);

}  // namespace stairstep::bench
