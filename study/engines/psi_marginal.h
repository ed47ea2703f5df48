// The psi-marginal method: threshold, slope and lapse rate (and guess rate) are all unknown, and the next stimulus is the
// one expected to tell most about the threshold alone (Kontsevich & Tyler 1999, Vision Research 39:2729; Prins 2013,
// J. Vision 13(7):3). With one slope and one lapse rate it is the minimum-entropy method of known shape.
//
// It is QUEST+ (study/engines/quest_plus.h) on the grid T × β × γ × δ under study/psychometric.h, with T at p_threshold for
// every shape. Thresholds and stimuli lie on one lattice, so Ψ depends on x − T alone: one short table a shape, along
// which a stimulus slides its window. A trial (suggest and update) on 251 thresholds × 52 shapes takes under 0.3 ms.
//
// Numbers. The posterior is e^b·m for each grid point: b a logarithm, m the product of the likelihoods since b was last
// brought up to date, which happens before m could underflow. Nothing is lost, and most trials cost one exponential a
// point. Likelihoods are exact at the intensity shown, on the lattice or off it. Only the choice of the next stimulus is
// computed in floats: of two stimuli whose expected entropies agree to 10⁻⁵ either is as good.
//
// Simulated tracks of 60 trials with T from the prior, default settings, 1,000 tracks each; share of 95 % intervals that hold
// T, for true δ .01 and .05: β 2: .954, .938 · β 3.5: .994, .991 · β 5: .999, .997. Shallower than the prior expects, β 1.3:
// .879, .849. With a known shape the SD of T is .110, .055, .038 after 20, 40, 60 trials (8,000 tracks; Fisher bound .053,
// .037, .031). Shorter runs of both are in tests/study/engines/psi_marginal_test.cpp.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "study/engines/estimate.h"
#include "study/engines/quest.h"
#include "study/psychometric.h"

namespace stairstep {

struct PsiMarginalSettings {
    /// Prior of T: normal with this mean and standard deviation, log10 units; guess_sd > 0.
    double guess = 0;
    double guess_sd = 0.5;
    /// Spacing of thresholds and stimuli, and full width of the thresholds around the guess, log10 units; grain > 0,
    /// range > 2·grain.
    double grain = 0.02;
    double range = 5;
    /// Slopes, evenly spaced in ln β; 0 < beta_low ≤ beta_high, beta_count ≥ 1. The prior of ln β is normal around
    /// ln beta_guess. A single slope is beta_low, which must then equal beta_high.
    double beta_low = 1;
    double beta_high = 10;
    int beta_count = 13;
    double beta_guess = 2.5;
    double beta_log_sd = 0.8;
    /// Lapse rates, evenly spaced in [0, 1), with the prior e^{−δ/delta_scale}; a single one as for slopes.
    double delta_low = 0;
    double delta_high = 0.1;
    int delta_count = 4;
    double delta_scale = 0.05;
    /// Guess rates, evenly spaced in [0, 1), all alike; a single one, as in forced choice, is known.
    double gamma_low = 0.5;
    double gamma_high = 0.5;
    int gamma_count = 1;
    /// Probability that defines T: between the highest γ and 1 − δ(1 − γ) of every shape.
    double p_threshold = 0.82;
    /// What a stimulus should tell about: T, or T and β together.
    bool learn_slope = false;
};

/// The minimum-entropy method for a known shape, with QUEST's prior and grid.
PsiMarginalSettings minimum_entropy_settings(const QuestSettings& settings);

struct PsiLattice;

class PsiMarginal {
  public:
    /// Throws InputError naming a setting that is out of its range, or a grid of more than 10⁷ points.
    explicit PsiMarginal(const PsiMarginalSettings& settings);

    /// The intensity to show next, log10 units. Candidates are up to 48 lattice points from where T may lie (99 % of
    /// its posterior) widened by the posterior mean of 1/β on either side, beyond which answers are guesses or lapses;
    /// the points around the best of them; and the lattice's easiest stimulus, whose answers tell lapses from
    /// shallow slopes. Of equal ones, the first tried.
    double suggest() const;

    /// Takes in an answer given at a finite intensity, log10 units.
    void update(double intensity, bool correct);

    /// Of the marginal posterior of T: mean, SD, and T below which `order` of its mass lies (interpolated between grid
    /// points), order in [0, 1].
    double mean() const { return mean_; }
    double sd() const { return sd_; }
    double quantile(double order) const;
    ThresholdEstimate estimate() const;

    /// Posterior means of ln β, exponentiated, and of δ.
    double beta() const;
    double delta() const;

    int trials() const { return trials_; }

    /// Expected information about what is to be learned from one answer at an intensity on the lattice nearest to the
    /// one given, nats; exact to about 10⁻⁵.
    double expected_information(double intensity) const;

  private:
    struct Blocks;

    double least_likelihood(size_t row, double intensity, bool correct) const;
    void update_row(size_t row, double intensity, bool correct, double common);
    void fold_row(size_t row);
    void set_reference();
    void summarise();
    Blocks blocks() const;
    std::vector<double> information(const Blocks& posterior, std::span<const int> stimuli) const;

    std::shared_ptr<const PsiLattice> lattice_;
    /// Row-major, a row a shape, a column a threshold: the posterior is scale·product, scale = e^(log_base − reference).
    std::vector<double> log_base_;
    std::vector<double> scale_;
    std::vector<double> product_;
    /// No product in the row is smaller than this.
    std::vector<double> row_floor_;
    double reference_ = 0;
    /// Normalised sums over shapes, and over thresholds.
    std::vector<double> marginal_;
    std::vector<double> shape_marginal_;
    double mass_ = 0;
    double mean_ = 0;
    double sd_ = 0;
    int trials_ = 0;
};

static_assert(AdaptiveEngine<PsiMarginal>);

}  // namespace stairstep
