// Staircases: after n right answers in a row the next trial is one step harder, after a wrong one a step easier.
//
// Steps up (easier) and down (harder) may differ in size. The staircase hovers where up and down balance,
// P(n right in a row)·S_down = (1 − P)·S_up, which is at
//
//   p = [S_up/(S_up + S_down)]^{1/n}
//
// Transformed (Levitt 1971, JASA 49:467): equal steps, 2 down 1 up p = .707, 3 down 1 up p = .794. Weighted (Kaernbach
// 1991, Percept. Psychophys. 49:227): n = 1 and S_up/S_down = p/(1 − p). Steps shrink at reversals, the trials where the
// direction turns. Intensities are log10 units, greater is easier.
//
// The threshold is the mean of the last reversals, moved from where Ψ = p to where Ψ = p_threshold under the shape assumed.
// The scatter of reversals is known to say little about that mean's error, for neighbouring reversals depend on each
// other. So a grid posterior of T (class Quest) takes in every trial as well. In `ThresholdEstimate`, low and high are its 2.5 %
// and 97.5 % quantiles, and sd is the root mean square error of the stated threshold under it,
// √(sd² + (threshold − mean)²): a reversal mean far from what all trials say has a large sd.
//
// A value without clock, file or randomness.
#pragma once

#include <vector>

#include "study/engines/estimate.h"
#include "study/engines/quest.h"

namespace stairstep {

struct StaircaseSettings {
    /// First intensity, relative to the prior's guess, log10 units.
    double start = 0.4;
    /// n: right answers in a row for a step down, ≥ 1.
    int down_after = 2;
    /// S_up/S_down, > 0.
    double up_over_down = 1;
    /// S_down before the first reversal, after one, and so on; the last one holds from then on. log10 units, each > 0.
    std::vector<double> steps{0.2, 0.1, 0.05};
    /// How many reversals are averaged: even, ≥ 2, so that peaks and valleys count alike.
    int averaged_reversals = 10;
    /// Prior, shape and grid of the posterior. Suggestions stay on its grid, guess ± range/2.
    QuestSettings posterior{};
};

/// p above. .7071 for 2 down 1 up, .7937 for 3 down 1 up.
double convergence_probability(const StaircaseSettings& settings);

/// Kaernbach's weighted up-down staircase for a probability in (0, 1): 4.556 for .82.
double weighted_up_over_down(double probability);

class Staircase {
  public:
    /// Throws InputError naming a setting that is out of its range, or a staircase that converges where the shape never
    /// gets.
    explicit Staircase(const StaircaseSettings& settings);

    /// The intensity to show next, log10 units.
    double suggest() const { return level_; }

    /// Takes in an answer given at a finite intensity, log10 units. Steps start from the intensity that was really
    /// shown, so that a display's limit doesn't let the staircase run off behind it.
    void update(double intensity, bool correct);

    /// As explained above. With fewer than two reversals the threshold is the posterior mean; with fewer than
    /// averaged_reversals, the mean of the largest even number of the last ones.
    ThresholdEstimate estimate() const;

    int trials() const { return posterior_.trials(); }
    int reversals() const { return reversals_; }

  private:
    StaircaseSettings settings_;
    Quest posterior_;
    double level_;
    /// From T to where the staircase converges.
    double offset_;
    int right_in_a_row_ = 0;
    /// −1 down, +1 up, 0 before the first step.
    int direction_ = 0;
    int reversals_ = 0;
    /// Intensities shown at the last reversals, at most averaged_reversals.
    std::vector<double> last_reversals_;
};

static_assert(AdaptiveEngine<Staircase>);

}  // namespace stairstep
