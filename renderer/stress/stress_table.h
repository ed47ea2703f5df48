// stress.md: the stress test as a table of Markdown, with one column a technique. Conditions of one kind whose cells are all the same
// share a row.
//
// A cell has the error of visibility (RMSE) and, only where there is any, acne, detachment of a tenth of a texel or more, NaN
// pixels and errors of GL; of a course the drift, and the growth of memory with that of its second half in brackets.
#pragma once

#include <string>
#include <vector>

#include "renderer/stress/stress_csv.h"

namespace stairstep::stress {

/// Of results that all have the same techniques, in the same order.
std::string stress_table(const std::vector<ConditionResult>& results);

}  // namespace stairstep::stress
