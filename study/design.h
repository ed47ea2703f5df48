// The design of a study: which conditions, in which order, and when a track ends. Defaults are Kreuzer's (2017,
// chapter 4) with two deviations: lines on half the trials, which γ = ½ needs, and a prior in the unit of the result.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study/engines/quest.h"
#include "study/trial.h"

namespace stairstep {

/// When a track ends: at `most_trials`, or from `least_trials` on as soon as its posterior SD is small enough.
struct StopRule {
    int least_trials = 10;
    int most_trials = 100;
    /// log10 units. 0.05 takes about 40 trials a track, and 640 trials fit the thesis's 25 minutes an observer.
    double converged_sd = 0.05;
};

struct Design {
    std::string name = "kreuzer-2017";
    std::vector<Pattern> patterns{Pattern::step, Pattern::stair};
    std::vector<double> contrasts{1, 0.5};
    std::vector<double> texels_px{5, 10, 20, 30};
    KernelShape kernel = KernelShape::box;
    /// `guess` is set for each track from `guess_radius_texels`: T = −log10(radius/texel).
    QuestSettings quest;
    double guess_radius_texels = 3;
    StopRule stop;
    /// What a display can show, px: suggestions outside are limited to it.
    double smallest_radius_px = 0.25;
    double largest_radius_px = 320;
};

/// One round: tracks that run interleaved.
struct Round {
    std::vector<Condition> tracks;
};

/// The rounds of the n-th observer (from 0): one for each pattern × contrast, each with a track a texel size. Their
/// order follows a balanced Latin square, so that over observers each stands in each place, and follows each other,
/// equally often (exactly so for every even number of rounds).
std::vector<Round> rounds_for(const Design& design, int observer_index);

/// Settings of the engine for one track.
QuestSettings quest_settings(const Design& design);

nlohmann::ordered_json to_json(const Design& design);

}  // namespace stairstep
