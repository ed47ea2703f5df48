// QUEST+: a Bayesian adaptive method for any number of stimulus dimensions, parameters and outcomes (Watson 2017,
// J. Vision 17(3):10).
//
// The model is a function ln p(outcome | stimulus, parameters). The posterior lives on the Cartesian grid of the
// parameters' values. The next stimulus is the one of the list after whose answer the entropy of the parameters of
// interest is expected to be smallest; nuisance parameters are summed out first (Prins 2013, J. Vision 13(7):3):
//
//   E[H](s) = −Σ_o Σ_θ a_o(θ)·ln a_o(θ) + Σ_o P_o·ln P_o,    a_o(θ) = Σ_ν p(θ, ν)·p(o | s, θ, ν),   P_o = Σ_θ a_o(θ)
//
// Without nuisance parameters this is H(p) − [h(P) − Σ_θ p(θ)·h(s, θ)], h the entropy of the outcome: what an answer is
// expected to tell. The h(s, θ) are tabulated at the start, so that choosing takes sums of products and no logarithms.
//
// A value without clock, file or randomness; copies share the constant tables and nothing else.
//
// Anchor: Watson's example 1 (41 contrasts × 41 thresholds, β 3.5, 32 trials) trial by trial, in
// tests/study/engines/quest_plus_test.cpp.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace stairstep {

struct QuestPlusParameter {
    std::string name{};
    /// Any finite numbers, in any order, at least one.
    std::vector<double> values{};
    /// A weight ≥ 0 for each value, not all 0; they need not sum to 1. None: all values alike.
    std::vector<double> prior{};
    /// Summed out before entropies are compared. At least one parameter must be of interest.
    bool nuisance = false;
};

/// Fills `log_p` with ln p(outcome | stimulus, parameters), one for each outcome; −∞ for an impossible one.
/// `parameters` come in the order of the settings. Logarithms, because probabilities too small for a double still say
/// which parameters are the likelier.
using OutcomeModel =
    std::function<void(std::span<const double> stimulus, std::span<const double> parameters, std::span<double> log_p)>;

struct QuestPlusSettings {
    /// The points that may be suggested, all of the same dimension.
    std::vector<std::vector<double>> stimuli{};
    /// The prior of the grid is the product of the parameters' priors.
    std::vector<QuestPlusParameter> parameters{};
    /// How many outcomes a trial can have, ≥ 2; they are numbered from 0.
    int outcomes = 2;
    OutcomeModel model{};
};

class QuestPlus {
  public:
    /// Evaluates the model once for each stimulus and grid point. Throws InputError naming a setting that is out of its
    /// range, a table of more than 10⁸ entries, or a model whose probabilities don't sum to 1 within 10⁻⁶.
    explicit QuestPlus(const QuestPlusSettings& settings);

    /// Index of the stimulus to show next; of equal ones the first in the list.
    size_t suggest() const;
    const std::vector<double>& stimulus(size_t index) const;

    /// Expected entropy of the parameters of interest after a trial at each stimulus, nats.
    std::vector<double> expected_entropies() const;

    /// Takes in an outcome at the point that was really shown, in the list or not: the model is evaluated there.
    /// Throws InputError for a point of another dimension, an unknown outcome, or where the model gives no
    /// probabilities. An outcome held impossible counts as e^(−10³⁰⁰), so that the posterior stays finite.
    void update(std::span<const double> stimulus, int outcome);

    /// The posterior of one parameter, by its index in the settings: one probability for each value; they sum to 1.
    std::vector<double> marginal(size_t parameter) const;
    /// Mean and standard deviation of that.
    double mean(size_t parameter) const;
    double sd(size_t parameter) const;
    /// The most probable point of the whole grid, in the order of the settings.
    std::vector<double> mode() const;

    int trials() const { return trials_; }

  private:
    struct Tables;

    std::shared_ptr<const Tables> tables_;
    std::vector<double> log_posterior_;
    /// e^log_posterior_, normalised.
    std::vector<double> posterior_;
    int trials_ = 0;

    void normalise();
};

}  // namespace stairstep
