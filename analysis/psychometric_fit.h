// Psychometric functions by maximum likelihood, from raw trials: threshold, slope, lapses and, where the task leaves it open,
// guessing.
//
// Ceres minimises −ln L = −Σ ln Ψ_k (right) − Σ ln(1 − Ψ_k) (wrong) as a GradientProblem with BFGS, from several starts; the
// binomial likelihood is no least-squares problem. Each parameter is bounded by θ = low + (high − low)·sin²φ, so that an
// optimum at a bound is a stationary point like any other; Newton steps finish. Covariances are the inverse of the observed
// information (the Hessian of −ln L by differences of the exact gradient) over the parameters that are not at a bound, never
// Ceres' covariance, which takes residuals of unit variance. Intervals of the threshold come from its profile likelihood.
//
// What data can't tell is said, not guessed: see PsychometricFit::reason.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/psychometric_function.h"

namespace stairstep {

struct Answer01 {
    /// x = log10(texel_px/radius_px).
    double strength = 0;
    bool correct = false;
};

/// All answers at one strength.
struct Level {
    double strength = 0;
    double right = 0;
    double trials = 0;
};

/// Sorted by strength; answers at equal strengths together.
std::vector<Level> levels_of(const std::vector<Answer01>& answers);

struct PsychometricFitSettings {
    Sigmoid sigmoid = Sigmoid::weibull;
    /// What defines the threshold; above guess, below 1 − largest_lapse·(1 − guess).
    double p_threshold = 0.75;
    /// γ, or where it starts if it is free (in [0, largest_guess]).
    double guess = 0.5;
    bool guess_is_free = false;
    double largest_guess = 0.6;
    /// δ in [0, largest_lapse]; 0 holds it at 0.
    double largest_lapse = 0.12;
    /// b lies between these.
    std::pair<double, double> slopes{0.05, 100};
};

/// In the order of PsychometricParameters: threshold, slope, lapse, guess.
constexpr int kPsychometricParameters = 4;

struct PsychometricFit {
    /// Empty where everything could be estimated; else what could not, and why: "all answers right", "all answers wrong",
    /// "one strength only", "the slope is at its upper bound: …". `estimated` says whether there are parameters at all.
    std::string reason;
    bool estimated = false;
    /// Whether the gradient vanishes: Newton's step would gain less than 10⁻⁹ in ln L.
    bool converged = false;

    PsychometricFitSettings settings;
    PsychometricParameters<double> parameters;
    /// Which parameters lie at a bound (or are fixed): they have no standard error.
    std::array<bool, kPsychometricParameters> at_bound{};
    /// Row by row; zeros for parameters at a bound. nullopt where the information is not positive definite.
    std::optional<std::array<double, kPsychometricParameters * kPsychometricParameters>> covariance;

    std::vector<Level> levels;
    double log_likelihood = 0;
    /// 2·(ln L of a function free at every level − ln L), and its terms: Σ residual² = deviance, signed by right answers more
    /// (+) or fewer (−) than predicted.
    double deviance = 0;
    std::vector<double> deviance_residuals;

    /// 95 % of the threshold by its profile likelihood, 2·(ln L_max − ln L(T)) ≤ 3.841; ±∞ on a side the data don't bound.
    std::pair<double, double> threshold_ci95;

    /// Ψ of x. Needs `estimated`.
    double probability(double strength) const;
    /// x where Ψ is p; nullopt unless γ < p < 1 − δ(1 − γ).
    std::optional<double> threshold_at(double p) const;
    /// √ of the threshold's variance; nullopt without a covariance or at a bound.
    std::optional<double> threshold_sd() const;
};

/// Throws InputError for strengths that are not finite, no trials, or settings out of range.
PsychometricFit fit_psychometric(const std::vector<Answer01>& answers, const PsychometricFitSettings& settings);
PsychometricFit fit_psychometric(const std::vector<Level>& levels, const PsychometricFitSettings& settings);

/// Parameters alone, by one run from where another fit ended: for simulated and reduced data. nullopt where it fails.
struct Refit {
    PsychometricParameters<double> parameters;
    double log_likelihood = 0;
    double deviance = 0;
};
std::optional<Refit> refit_from(const PsychometricFit& fit, const std::vector<Level>& levels);

/// Signed root of a level's contribution to the deviance, at Ψ = 1 − wrong.
double deviance_residual(const Level& level, double wrong);

/// Gradient of ln L of one answer by the parameters, at the fit: what leaving it out changes.
std::array<double, kPsychometricParameters> score(const PsychometricFit& fit, const Answer01& answer);

}  // namespace stairstep
