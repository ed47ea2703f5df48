// The stress test as a page: a table of all conditions. It needs no network and no other file.
#pragma once

#include <string>
#include <vector>

#include "renderer/stress/stress_csv.h"

namespace stairstep::stress {

std::string stress_page(const std::vector<ConditionResult>& results, const Setting& setting);

/// Rows with NaN pixels, errors of GL, or a failure.
size_t broken_rows(const std::vector<ConditionResult>& results);

}  // namespace stairstep::stress
