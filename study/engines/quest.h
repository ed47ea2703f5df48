// QUEST: a Bayesian adaptive staircase for one threshold (Watson & Pelli 1983).
//
// A value: it holds the posterior of the threshold T on a grid, as logarithms, and knows neither clock nor file. Each
// trial multiplies the posterior by the likelihood of the answer at the intensity that was really shown, on the grid or
// off it. The next intensity is the posterior mean, moved by a fixed offset to where a trial tells most about T
// (for β 3.5, γ .5, δ .01 that is +.064, at Ψ = .908).
//
// Accuracy over 2,000 simulated tracks (tests/study/engines/quest_test.cpp): SD of the estimate .056 after 40 trials,
// against .0374 for the Fisher bound.
#pragma once

#include <vector>

#include "study/engines/estimate.h"
#include "study/psychometric.h"

namespace stairstep {

struct QuestSettings {
    /// Prior of T: normal with this mean and standard deviation, log10 units; guess_sd > 0.
    double guess = 0;
    double guess_sd = 0.5;
    PsychometricShape shape{};
    /// Grid spacing and full width around the guess, log10 units; grain > 0, range > 2·grain.
    double grain = 0.01;
    double range = 5;
};

class Quest {
  public:
    /// Throws InputError naming a setting that is out of its range, or a grid of more than 10⁶ points.
    explicit Quest(const QuestSettings& settings);

    /// The intensity to show next, log10 units.
    double suggest() const;

    /// Takes in an answer given at a finite intensity, log10 units.
    void update(double intensity, bool correct);

    /// Posterior mean and standard deviation of T.
    double mean() const;
    double sd() const;
    /// T below which `order` of the posterior's mass lies, interpolated between grid points; order in [0, 1].
    double quantile(double order) const;
    Estimate estimate() const;

    int trials() const { return trials_; }

  private:
    double threshold_at(size_t i) const { return first_threshold_ + i * grain_; }
    void summarise();

    PsychometricShape shape_;
    double offset_;
    double placement_;
    double first_threshold_;
    double grain_;
    std::vector<double> log_posterior_;
    double mean_ = 0;
    double sd_ = 0;
    int trials_ = 0;
};

/// x − T at which one trial carries most Fisher information about T.
double most_informative_offset(const PsychometricShape& shape);

/// That information: 17.789 per squared log10 unit for β 3.5, γ .5, δ .01, p_T .82. No method can estimate T with a
/// smaller SD than 1/√(n·I + 1/σ₀²).
double largest_information(const PsychometricShape& shape);

static_assert(AdaptiveEngine<Quest>);

}  // namespace stairstep
