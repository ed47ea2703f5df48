// The likelihood of answers under a psychometric function, and where it is largest: the optimiser beneath psychometric_fit.h.
//
// θ = (T less the middle of the strengths shown, ln b, δ, γ), each bounded by an interval; an empty one fixes its parameter.
// Ceres minimises −ln L as a GradientProblem with BFGS over φ, θ = low + (high − low)·sin²φ, so that an optimum at a bound is a
// stationary point like any other; Newton steps finish. ln L and its gradient are exact (Jets); the information matrix is the
// gradient's central difference.
//
// Anchor: one strength with k of n right, T free alone: the optimum has Ψ = k/n, its information in p is n/(p(1 − p)).
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "analysis/psychometric_fit.h"

namespace stairstep {

using PsychometricVector = std::array<double, kPsychometricParameters>;

/// The levels and settings must outlive it.
class PsychometricLikelihood {
  public:
    /// At least one level, sorted by strength (asserted); valid settings.
    PsychometricLikelihood(const std::vector<Level>& levels, const PsychometricFitSettings& settings);

    /// In the function's own parameters, T still about the middle.
    PsychometricParameters<double> parameters(const PsychometricVector& theta) const;
    /// The way back, from parameters with T as it is.
    PsychometricVector theta_of(const PsychometricParameters<double>& parameters) const;

    /// ln L and, unless null, its gradient; false where an answer is impossible.
    bool evaluate(const PsychometricVector& theta, double& value, PsychometricVector* gradient) const;

    /// The middle of the strengths shown, from which T is measured.
    double middle() const { return middle_; }
    const PsychometricVector& low() const { return low_; }
    const PsychometricVector& high() const { return high_; }
    bool is_fixed(int i) const { return !(high_[i] > low_[i]); }
    /// Where in its interval a parameter lies, 0 to 1.
    double share(const PsychometricVector& theta, int i) const { return (theta[i] - low_[i]) / (high_[i] - low_[i]); }
    bool is_at_upper_bound(const PsychometricVector& theta, int i) const;

    std::vector<int> not_fixed() const;
    /// Of those, the ones that are not at a bound.
    std::vector<int> inside(const PsychometricVector& theta) const;

    const std::vector<Level>& levels() const { return levels_; }
    const PsychometricFitSettings& settings() const { return settings_; }

  private:
    template <typename T>
    bool sum(const std::array<T, kPsychometricParameters>& theta, T& total) const;

    const std::vector<Level>& levels_;
    const PsychometricFitSettings& settings_;
    double middle_;
    PsychometricVector low_{}, high_{};
};

struct LikelihoodOptimum {
    PsychometricVector theta{};
    /// ln L; −∞ where no function that explains the answers was found.
    double value = -INFINITY;
};

/// ln L at its largest over the free parameters, from `start`.
LikelihoodOptimum climb(const PsychometricLikelihood& likelihood, const PsychometricVector& start,
                        const std::vector<int>& free);

/// The best of several climbs, from a lattice's best points that don't lie beside each other.
LikelihoodOptimum best_of_starts(const PsychometricLikelihood& likelihood);

/// Newton steps while they gain; whether the last would have gained next to nothing.
bool finish(const PsychometricLikelihood& likelihood, LikelihoodOptimum& optimum);

/// −∂²ln L over some parameters. nullopt where ln L ends too soon.
std::optional<Eigen::MatrixXd> information(const PsychometricLikelihood& likelihood, const PsychometricVector& theta,
                                           const std::vector<int>& free);

/// Covariance from information; nullopt where the likelihood is flat in some direction, to what differences can tell.
std::optional<Eigen::MatrixXd> invert(const PsychometricLikelihood& likelihood, const Eigen::MatrixXd& information,
                                      const std::vector<int>& free);

/// Where twice ln L, maximised over all but T, has fallen by `bound` from its largest: below (direction −1) or above (+1) it,
/// ±∞ where it never does. `step` > 0: how far to look first, log10 units.
double profile_end(const PsychometricLikelihood& likelihood, const LikelihoodOptimum& best, double bound,
                   double direction, double step);

}  // namespace stairstep
