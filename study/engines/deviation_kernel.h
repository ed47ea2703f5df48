// How far a track's threshold may lie from the law: T = θ + e, e ~ N(0, σ²), on a grid both share.
//
// On the grid P(t_j | θ_i) = w(j − i)/Z_i with w(l) = exp(−(l·grain)²/2σ²) and Z_i the sum over the grid's points, so that
// every θ_i shares out exactly 1. σ = 0 is w = 1 at l = 0 alone: T = θ. For σ ≥ 0.6 grains the SD of the steps is σ to
// 1.2 %, from 0.8 grains on to 1e-4. σ may be as large as one likes: the rows then become uniform.
//
// Both sums that a posterior needs are logarithms in and logarithms out, so that nothing underflows:
//   log_given_law      out_i = ln Σ_j P(t_j | θ_i)·exp(in_j)      of a track's likelihood: what it says of θ
//   log_given_track    out_j = ln Σ_i P(t_j | θ_i)·exp(in_i)      of what is known of θ: the prior of a track
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stairstep {

class DeviationKernel {
  public:
    /// σ in log10 units, 0 or at least half a grain; grain > 0; points ≥ 1.
    DeviationKernel(double sd, double grain, size_t points);

    size_t points() const { return log_row_mass_.size(); }
    /// ln w of a distance in grid points, < points(); −∞ beyond 0 if σ = 0.
    double log_weight(size_t distance) const { return log_weights_[distance]; }
    double weight(size_t distance) const { return mirrored_[points() - 1 + distance]; }
    /// w(j − i) at [points() − 1 + j − i]: a row or a column is a piece of it.
    std::span<const double> mirrored_weights() const { return mirrored_; }
    /// ln Z_i.
    double log_row_mass(size_t i) const { return log_row_mass_[i]; }
    /// The farthest distance with ln w ≥ −depth.
    size_t reach(double depth) const;

    /// Spans of points() finite numbers; in and out may not overlap. To relative 1e-13.
    void log_given_law(std::span<const double> in, std::span<double> out) const;
    void log_given_track(std::span<const double> in, std::span<double> out) const;

  private:
    void log_convolve(std::span<const double> in, std::span<double> out) const;

    double sd_;
    double grain_;
    std::vector<double> mirrored_;
    std::vector<double> log_weights_;
    std::vector<double> log_row_mass_;
};

}  // namespace stairstep
