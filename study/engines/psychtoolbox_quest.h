// QUEST exactly as Psychtoolbox 3 computes it, for comparing with data analysed there.
//
// Watson & Pelli (1983) with the arithmetic of Psychtoolbox's QuestCreate, QuestUpdate, QuestMean, QuestMode,
// QuestQuantile and QuestSd (q.normalizePdf = 1): the same tables, the same order of operations, so the same numbers, to
// rounding, whatever the sequence. tests/study/engines/psychtoolbox_quest_test.cpp compares them with Psychtoolbox under
// Octave, to 1e-9 over up to 3,000 trials.
//
// What Psychtoolbox does, in short. The threshold is held on points x_i = i·grain, i = −dim/2 … dim/2, about the guess,
// with dim = 2·⌈range/grain/2⌉. The psychometric function is a table of 2·dim + 1 points, the same grain apart; a trial
// multiplies the posterior by a stretch of it, shifted by the whole number of grains that lies nearest to
// intensity − guess, and divides by the sum.
//
// Its faults are kept, because the numbers depend on them; `Quest` (study/engines/quest.h) has none of them:
//  - an intensity counts as the grid point nearest to it, and one beyond guess ± dim·grain/2 as one at that end: with the
//    default grid, hits at +2.6 and at +5 over the guess give one posterior (clamped_trials() counts these);
//  - the table's offset, x_threshold(), is interpolated linearly: wrong by up to 6.5e-4 at grain 0.1;
//  - a gamma above p_threshold is replaced by 0.5 (gamma() tells);
//  - without a range the grid has 501 points whatever the grain;
//  - range/grain is rounded up, errors of rounding included: range 4.2 with grain 0.1 has 45 points, not 43;
//  - a point whose posterior once underflows stays at 0; where delta = 0 lets all of them vanish, nothing is left but NaN;
//  - the quantile interpolates the cumulated sum between points, as if each point's mass lay in the cell below it: half a
//    grain lower than the mean and mode take it, and with all mass on one point the first cell reaches from there down to
//    the grid's lowest point.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "study/engines/estimate.h"
#include "study/psychometric.h"

namespace stairstep {

struct PsychtoolboxQuestSettings {
    /// Normal prior of the threshold, in the scale of the intensities; guess_sd > 0. Psychtoolbox has no defaults for
    /// these two; its QuestDemo proposes −1 and 2.
    double guess = -1;
    double guess_sd = 2;
    /// beta > 0, gamma and delta in [0, 1), p_threshold in (0, 1). Defaults as in QuestDemo.
    PsychometricShape shape{};
    /// Distance of the grid points, > 0.
    double grain = 0.01;
    /// Width of the grid around the guess, > 0; without one, 500 grains.
    std::optional<double> range = std::nullopt;
};

class PsychtoolboxQuest {
  public:
    /// Throws InputError where a setting is out of its range, the grid would have more than 10⁶ points, or the table of
    /// the psychometric function doesn't reach p_threshold.
    explicit PsychtoolboxQuest(const PsychtoolboxQuestSettings& settings);

    /// The quantile of quantile_order(), as Psychtoolbox recommends.
    double suggest() const { return quantile(); }

    /// Takes in an answer at a finite intensity.
    void update(double intensity, bool correct);

    /// QuestMean, QuestMode (of equal points the lowest) and QuestSd (its root of a rounding error below 0 is 0). NaN
    /// once the posterior has vanished; the mode is then the grid's lowest point.
    double mean() const;
    double mode() const;
    double sd() const;

    /// QuestQuantile, of an order in [0, 1]. Throws InputError for another order, FailureError where the posterior has
    /// vanished or nothing is left of it but the grid's lowest point.
    double quantile() const { return quantile(quantile_order_); }
    double quantile(double order) const;

    /// QuestMean and QuestSd, and the quantiles 0.025 and 0.975. Throws as `quantile`.
    ThresholdEstimate estimate() const { return {mean(), sd(), quantile(0.025), quantile(0.975)}; }

    /// q.quantileOrder: best_quantile_order of study/engines/quest.h, from the table's ends.
    double quantile_order() const { return quantile_order_; }
    /// q.xThreshold, ε: 0.0571778… for β 3.5, γ 0, δ 0, p_T .795 and grain 0.01 (exactly: 0.0571312…).
    double x_threshold() const { return x_threshold_; }
    /// q.gamma: as given, or 0.5 in place of one above p_threshold.
    double gamma() const { return gamma_; }

    int trials() const { return trials_; }
    /// Trials whose intensity was beyond the tables and taken as one at their end.
    int clamped_trials() const { return clamped_trials_; }

  private:
    double x(size_t i) const { return (static_cast<double>(i) - half_) * grain_; }
    double pdf(size_t i) const { return pdf_[i] / sum_; }
    void sum_up();
    void find_support();

    double guess_;
    double grain_;
    double gamma_;
    double half_;
    double x_threshold_;
    double quantile_order_;
    /// Probabilities of a wrong and of a right answer, from the highest intensity relative to threshold to the lowest.
    std::vector<double> wrong_;
    std::vector<double> right_;
    /// The posterior before the division by its sum.
    std::vector<double> pdf_;
    double sum_ = 1;
    /// Outside [first_, last_) the posterior is 0, and stays so.
    size_t first_ = 0;
    size_t last_ = 0;
    int trials_ = 0;
    int clamped_trials_ = 0;
};

static_assert(AdaptiveEngine<PsychtoolboxQuest>);

}  // namespace stairstep
