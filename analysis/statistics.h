// Means and their intervals, quantiles, and adjusting for several tests at once.
#pragma once

#include <span>
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

/// The value that a Student's t of so many degrees of freedom stays below with probability p in (0, 1).
double t_quantile(double p, double degrees_of_freedom);

/// P(|T| ≥ |t|) of Student's t; 0 for an infinite t. Anchor: t = 2.262157 with 9 degrees of freedom → .05.
double t_two_sided_p(double t, double degrees_of_freedom);

double normal_cdf(double z);
/// Its inverse, p in (0, 1).
double normal_quantile(double p);

/// The p-quantile, 0 ≤ p ≤ 1, of ascending values, at least one: linear between order statistics, the k-th of n at
/// (k − 1)/(n − 1) (R's type 7). Anchor: of 1, 2, 3, 4 at .25 → 1.75.
double quantile_of_sorted(std::span<const double> ascending, double p);

double median(std::vector<double> values);

/// Holm's step-down p values (Holm 1979), in the order given: the i-th smallest of m is multiplied by m − i + 1, made
/// monotone, and held at 1. Rejecting those below α keeps the chance of any false one at α, whatever the dependence.
/// Anchor: {.01, .04, .03, .005} → {.03, .06, .06, .02}.
std::vector<double> holm_adjusted(const std::vector<double>& p_values);

}  // namespace stairstep
