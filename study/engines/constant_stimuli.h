// The method of constant stimuli: fixed intensities, each as often as the others, in random order (Fechner 1860). The
// answers don't change what is shown, so it is the plain yardstick for methods that adapt.
//
// Trials come in blocks that hold every level once, each block shuffled on its own: at any time the levels have been shown
// equally often, give or take one. The order follows from the seed alone. The threshold comes from a grid posterior of
// all trials with known shape (class Quest).
#pragma once

#include <cstdint>
#include <vector>

#include "study/engines/estimate.h"
#include "study/engines/quest.h"

namespace stairstep {

struct ConstantStimuliSettings {
    /// Intensities relative to the prior's guess, log10 units; at least one.
    std::vector<double> levels{-0.45, -0.3, -0.15, 0, 0.15, 0.3, 0.45};
    /// How often each level is meant to be shown, ≥ 1.
    int repetitions = 10;
    uint64_t seed = 1;
    /// Prior, shape and grid of the posterior.
    QuestSettings posterior{};
};

class ConstantStimuli {
  public:
    /// Throws InputError naming a setting that is out of its range.
    explicit ConstantStimuli(const ConstantStimuliSettings& settings);

    /// The intensity to show next, log10 units. Beyond the planned trials, further blocks follow.
    double suggest() const;

    /// Takes in an answer given at a finite intensity, log10 units, at a level or not.
    void update(double intensity, bool correct) { posterior_.update(intensity, correct); }

    ThresholdEstimate estimate() const { return posterior_.estimate(); }
    int trials() const { return posterior_.trials(); }

    /// Levels × repetitions.
    int planned_trials() const;

  private:
    ConstantStimuliSettings settings_;
    Quest posterior_;
};

static_assert(AdaptiveEngine<ConstantStimuli>);

}  // namespace stairstep
