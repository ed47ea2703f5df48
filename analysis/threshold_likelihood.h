// Likelihoods of a track's answers over a grid of thresholds: the tables that threshold_posterior.h sums.
//
// Locations are L = T − ε(β, δ), on which u = 10^{β(x − L)} is a geometric sequence, the same for all strengths but for where
// it starts, and e^{−u} the same table for all δ: Ψ = 1 − (1 − γ)(δ + (1 − δ)e^{−u}), γ = ½, is linear in it. Factors are
// multiplied many at a time before their logarithm is taken.
//
// Anchor: ln Ψ of study/psychometric.h, to 10⁻⁹.
#pragma once

#include <cstddef>
#include <vector>

namespace stairstep {

/// The guess rate of all tables here: lines are shown on half the trials.
constexpr double kGuessRate = 0.5;

/// Equal trials of one track, together.
struct PooledTrials {
    /// x = log10(texel_px/radius_px).
    double strength = 0;
    bool correct = false;
    double count = 1;
};

/// Sorted by strength, wrong answers before right ones; one entry for each strength and answer.
std::vector<PooledTrials> pool(std::vector<PooledTrials> trials);

/// Locations, an even number of them, from the first to the last; log10 units.
struct LocationGrid {
    double first = 0;
    double last = 0;
    size_t points = 2;

    double spacing() const { return (last - first) / static_cast<double>(points - 1); }
    double at(size_t i) const { return first + spacing() * static_cast<double>(i); }
};

/// Adds Σ count·ln Ψ of every `stride`-th of the pooled trials to log_likelihood, which has deltas.size() rows of grid.points.
/// Independent answers. beta > 0, deltas in [10⁻⁷, 1).
void add_log_likelihood(std::vector<double>& log_likelihood, const std::vector<PooledTrials>& pooled, size_t stride,
                        const LocationGrid& grid, double beta, const std::vector<double>& deltas);

/// The same with answers at one strength going together (overdispersion.h), eta in [0, 1).
void add_overdispersed_log_likelihood(std::vector<double>& log_likelihood, const std::vector<PooledTrials>& pooled,
                                      size_t stride, const LocationGrid& grid, double beta,
                                      const std::vector<double>& deltas, double eta);

/// Σ count·ln Ψ of all answers on the grid.
std::vector<double> location_log_likelihood(const std::vector<PooledTrials>& pooled, double beta, double delta,
                                            const LocationGrid& grid);

}  // namespace stairstep
