// The mean of a quantity that differs between observers and is measured on each with an error of its own.
//
//   y_j ~ N(μ, τ² + s_j²)          observer j's estimate y_j, its standard error s_j, spread between observers τ
//
// With weights w_j = 1/(τ² + s_j²), μ̂ = Σ w_j y_j/Σ w_j. τ² maximises the restricted likelihood, which allows for μ̂ being
// fitted to the same data,
//
//   ℓ_R(τ²) = −½[Σ ln(τ² + s_j²) + ln Σ w_j + Σ w_j (y_j − μ̂)²],
//
// or, for ML, the same without ln Σ w_j. Equal s_j have closed forms: REML τ² = max(0, sd² − s²), ML max(0, sd²(n − 1)/n − s²).
//
// Intervals for μ, all of 95 %:
// - Knapp & Hartung (2003): μ̂ ± t_{n−1}·√(q/Σ w_j) with q = Σ w_j (y_j − μ̂)²/(n − 1). Equal s_j give the plain t interval. Some
//   raise q to at least 1; not here: with equal s_j and τ = 0 it then covers 98 % and more, without it exactly 95 %. Simulated
//   with s_j that differ threefold, 3 to 30 observers and τ of 0 to .16: 92–95 %. Where two observers of ten are ten times as
//   precise as the rest it covers only 81 %: the weights are two observers', t_{n−1} is not.
// - Sandwich: μ̂ ± t_ν·√V, V = Σ p_j² e_j²/(1 − p_j) with p_j = w_j/Σ w, e_j = y_j − μ̂: no bias if the weights are right, and
//   true to what observers vary where they are not (Bell & McCaffrey 2002, "CR2"); ν = 2·E(V)²/Var(V) under the weights'
//   model (Satterthwaite; Tipton 2015), 1/ν = Σ p_j² + Σ_{i≠j} a_i a_j with a_j = p_j²/(1 − p_j). Equal s_j give the plain t interval. Simulated as above: 95–96 %; where Knapp &
//   Hartung's covers 81 %, 93–98 %, and 99 % where τ is 0 there. 4,000 studies each, 5, 10 and 20 observers.
// - Profile likelihood: all μ with 2[max ℓ − max_τ ℓ(μ, τ)] ≤ n·ln(1 + t²_{n−1,.975}/(n − 1)). For equal s_j and τ̂ > 0 the left
//   side is n·ln(1 + t²/(n − 1)) of the t statistic, so this bound makes the interval exact where χ²'s 3.84, which it tends to,
//   is too narrow (10 observers: 4.50).
// - Posterior: μ flat, τ half-Cauchy with a stated scale. Given τ, μ is N(μ̂(τ), 1/Σ w_j(τ)); τ is summed over a grid.
//
// Anchor: the 13 trials of the BCG vaccine, log relative risks (Colditz et al. 1994): τ² = .3132, μ̂ = −.7145, 1/√Σw = .1798.
#pragma once

#include <span>
#include <utility>
#include <vector>

namespace stairstep {

/// One observer's estimate and its standard error ≥ 0, both finite.
struct Effect {
    double value = 0;
    double se = 0;
};

struct RandomEffects {
    /// μ̂.
    double mean = 0;
    /// τ̂ ≥ 0, in the unit of the values.
    double tau = 0;
    /// 1/√Σ w_j: the standard error of μ̂ were τ known.
    double model_se = 0;
    /// Knapp & Hartung's: √(q/Σ w_j).
    double se = 0;
    /// μ̂ ± t_{n−1}·se; one observer has no interval, and it is μ̂ itself.
    std::pair<double, double> ci95;
    /// Share of the weight that each observer has; they sum to 1.
    std::vector<double> weight;
};

enum class TauMethod { reml, ml };

/// At least one effect (asserted). One has τ = 0. Equal values with no errors give a point.
RandomEffects fit_random_effects(std::span<const Effect> effects, TauMethod method = TauMethod::reml);

/// The same without the interval, which stays at the mean: what bootstraps repeat.
RandomEffects estimate_random_effects(std::span<const Effect> effects, TauMethod method = TauMethod::reml);

/// As `fit_random_effects`, for a τ that is given.
RandomEffects random_effects_at(std::span<const Effect> effects, double tau);

/// What `fit`, of these effects, is worth where its weights may be wrong.
struct SandwichInterval {
    /// √V.
    double se = 0;
    /// ν in [1, n − 1].
    double degrees_of_freedom = 1;
    /// μ̂ ± t_ν·se.
    std::pair<double, double> ci95;
};
/// At least two effects (asserted). Equal errors give ν = n − 1 and Knapp & Hartung's interval.
SandwichInterval sandwich_interval(std::span<const Effect> effects, const RandomEffects& fit);

/// The bound of the profile likelihood that is exact for n ≥ 2 observers with equal errors. Anchor: n = 10 → 4.5018.
double profile_bound(size_t observers);

struct ProfileInterval {
    /// Maximum-likelihood μ.
    double mean = 0;
    std::pair<double, double> interval;
};
/// All μ whose profile deviance is within `bound`; at least two effects (asserted).
ProfileInterval profile_likelihood(std::span<const Effect> effects, double bound);

struct Posterior {
    /// Posterior medians.
    double mean = 0;
    double tau = 0;
    /// Equal-tailed 95 %.
    std::pair<double, double> mean_ci95;
    std::pair<double, double> tau_ci95;
};
/// τ is half-Cauchy with this scale > 0, its median. At least two effects (asserted).
Posterior random_effects_posterior(std::span<const Effect> effects, double tau_scale);

}  // namespace stairstep
