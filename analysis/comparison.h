// Paired comparisons of conditions: step against stair at each contrast, full contrast against each lower one for each pattern.
//
// Over the observers j who have both, d_j = ln c_j,first − ln c_j,second; the ratio is exp of their mean, its interval and p from
// Student's t of d. What observers have in common in both conditions cancels, so that a pair tells more than two separate
// intervals. p values are adjusted for the whole family by Holm's method.
#pragma once

#include <string>
#include <vector>

#include "analysis/law/law_file.h"

namespace stairstep {

/// All comparisons among the conditions, from their `observer_slopes`; conditions of different kernels are not compared. A pair
/// with fewer than two common observers is left out and named in `warnings`.
std::vector<Comparison> paired_comparisons(const std::vector<ConditionLaw>& conditions,
                                           std::vector<std::string>& warnings);

}  // namespace stairstep
