// How costs grow, as a page: a figure and a table of exponents an axis. It needs the files beside it and no network.
#pragma once

#include <string>
#include <vector>

#include "renderer/scaling/scaling_csv.h"

namespace stairstep::scaling {

/// `scenario` says in words what all axes start from. Figures are the files that `figure_file` names.
std::string scaling_page(const std::vector<AxisCurves>& axes, const Setting& setting, const std::string& scenario);

/// "radius.svg".
std::string figure_file(const std::string& axis);

}  // namespace stairstep::scaling
