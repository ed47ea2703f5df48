// Means and their intervals.
#pragma once

#include <utility>
#include <vector>

namespace stairstep {

/// A mean over independent units and what it is worth.
struct MeanEstimate {
    double mean = 0;
    /// Standard deviation between the units.
    double sd = 0;
    /// mean ± t_{n−1, .975}·sd/√n, Student's t.
    std::pair<double, double> ci95;
};

/// Needs at least two finite values (asserted).
MeanEstimate mean_with_interval(const std::vector<double>& values);

}  // namespace stairstep
