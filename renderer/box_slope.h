// The slope that the renderer's box filters go by.
#pragma once

#include <string>

#include "analysis/law/law_file.h"

namespace stairstep {

/// c for the box, from a law that `source` names. Throws InputError for a law of another kernel, unless it may be converted by
/// equal variance.
double box_slope(const Law& law, const std::string& source, bool convert_kernel);

}  // namespace stairstep
