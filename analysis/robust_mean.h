// A mean over observers that one wild observer can't drag away: Huber's M-estimate (1964) with the spread from the median
// absolute deviation.
//
//   Σ_j ψ(z_j)/σ_j = 0,   z_j = (y_j − μ)/σ_j,   σ_j² = τ² + s_j²,   ψ(z) = max(−k, min(k, z)),   k = 1.345
//
// τ² = max(0, (1.4826·MAD)² − median s_j²). k gives 95 % of the mean's precision for normal observers. An observer's weight is
// ψ(z)/z: 1 within k·σ, k/|z| beyond. The interval is μ ± t_{n−1}·se with the sandwich se² = n/(n − 1)·Σ(ψ_j/σ_j)²/(Σ ψ'_j/σ_j²)²;
// where nobody is down-weighted and s_j are equal that is the plain t interval.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "analysis/random_effects.h"

namespace stairstep {

/// k, in standard deviations.
constexpr double kHuberBound = 1.345;

struct RobustMean {
    double mean = 0;
    double tau = 0;
    double se = 0;
    std::pair<double, double> ci95;
    /// ψ(z)/z in (0, 1], one an observer.
    std::vector<double> weight;
};

/// At least one effect (asserted). With fewer than four there is no telling who is wild: all weights are 1, and the mean is that
/// of `fit_random_effects`; likewise where more than half of the values are the same, and where no more than one value lies
/// within the bound.
RobustMean huber_mean(std::span<const Effect> effects);

}  // namespace stairstep
