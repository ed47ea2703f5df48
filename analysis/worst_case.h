// The largest of several conditions' means, with an interval that knows it was picked as the largest.
//
// θ = max_k μ_k over conditions that share observers; m_k, se_k and t_{n−1} as of Knapp & Hartung. The picked condition's own
// interval is wrong where conditions are alike: the largest of several estimates lies above the truth. Instead
//
//   max_k (m_k − q·se_k)  ≤ θ ≤  max_k (m_k + t_{n_k−1,.975}·se_k),     P(max_k (m_k − μ_k)/se_k ≤ q) = .975.
//
// Lower end: it exceeds θ only where some m_k − q·se_k > θ ≥ μ_k, so with at most 2.5 %; exactly 2.5 % where all μ_k are
// equal. Upper end: it misses θ only if the condition that is truly largest does, 2.5 % where one stands out, less otherwise.
// So it covers at least 95 %; simulated with four conditions of ten observers, 97.4 % where all are equal (the picked one's own
// interval: 90–94 %) and 96.7 % where one stands out.
//
// q by simulation, because conditions are correlated: studies of normal observers with the correlation that the residuals have
// (each simulated observer is a normal mixture of the real ones' standardised residuals, which has exactly that covariance)
// and the same observers missing. Anchor: one condition → q = t_{n−1,.975}; k copies of one condition the same.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis/random_effects.h"

namespace stairstep {

/// A condition: what was estimated from each observer.
using EffectsByObserver = std::map<std::string, Effect>;

struct WorstCase {
    /// Which condition has the largest mean, and that mean.
    size_t condition = 0;
    double mean = 0;
    std::pair<double, double> ci95;
    /// q; the picked condition alone would have t_{n−1,.975}.
    double critical_value = 0;
};

/// A condition's m_k and se_k.
struct ConditionMean {
    double mean = 0;
    double se = 0;
};

/// At least one condition, each with two observers or more (asserted). `means` replace Knapp & Hartung's where there are any, one
/// a condition, as a robust fit's and the sandwich's do, whose errors are scaled to t_{n−1}; q stays that of the correlation between conditions. The same seed gives the same q; simulated studies number
/// 4,000, which leaves q uncertain by about 2.5 %.
WorstCase worst_case(const std::vector<EffectsByObserver>& conditions, uint64_t seed, int jobs = 1,
                     const std::vector<ConditionMean>& means = {});

}  // namespace stairstep
