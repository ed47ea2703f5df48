// The posterior of a threshold T, steepness and lapses summed out: what fit_threshold rests on.
//
//   p(T | trials) ∝ ∫∫ Π_k Ψ_k(x_k; T, β, δ) · p(β) p(δ) dβ dδ · p(T)
//
// Ψ as in study/psychometric.h with γ = ½. ln β is summed by the trapezoid rule, δ by Gauss's, T on an even grid of
// locations L = T − ε(β, δ), on which e^{−u} is the same table for all δ. Where the posterior turns out to be narrower than
// the grid resolves, the grid closes in on it and the sum is done again; a long track finds its place from every so many-th
// trial first. So the result doesn't hang on the grid: a finer one changes mean and SD by less than 1 % of the SD.
//
// Time: 1 ns or so a trial and grid point: 1 ms for a track of 40 trials, 15 s for a million different strengths. Memory: the
// trials once, pooled.
#pragma once

#include <utility>
#include <vector>

#include "analysis/threshold_likelihood.h"

namespace stairstep {

/// What is known of an observer beforehand: ln β is normal, δ exponential, cut off at largest_lapse.
///
/// 95 % of observers have β from 1.2 to 7.2: from half the steepness that detection has (3.5, Watson & Pelli 1983) in tasks of
/// that kind to twice it. δ is small in observers who attend: one answer in 65 given blindly, half of those wrong. Where more
/// lapses are allowed for, every track of right answers with a few wrong ones may be an inattentive observer's who sees all: a long
/// tail of low thresholds that makes SDs half as large again and intervals no truer.
struct ShapePrior {
    double median_beta = 3;
    double ln_beta_sd = 0.45;
    double mean_lapse = 0.015;
    double largest_lapse = 0.08;
};

struct ThresholdPosterior {
    double mean = 0;
    double sd = 0;
    /// Quantiles .025 and .975.
    std::pair<double, double> ci95;
    /// Share of the mass within 0.1 of either end of T's range if T's prior were flat up to the margins: none to speak of
    /// where the trials bound T.
    double low_end_share = 0;
    double high_end_share = 0;
    /// Posterior mean of overdispersion; 0 where none was asked for.
    double overdispersion = 0;
};

struct PosteriorSettings {
    /// In [0.55, 0.9].
    double p_threshold = 0.82;
    ShapePrior prior;
    /// T is as likely anywhere among the strengths shown; beyond them its prior falls off as a normal density with this SD,
    /// and is cut off at the margin, log10 units. (As in psignifit 4: who chose the strengths looked for T there.)
    double beyond_sd = 0.2;
    double margin = 0.8;
    /// Whether answers at the same strength may go together: see overdispersion.h.
    bool overdispersed = false;
    /// Grid points are this many times as dense in each direction; 1 but for checks.
    double refinement = 1;
};

/// Needs at least one trial, finite strengths and positive counts (asserted).
ThresholdPosterior threshold_posterior(const std::vector<PooledTrials>& pooled, const PosteriorSettings& settings);

}  // namespace stairstep
