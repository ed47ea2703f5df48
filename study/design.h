// The design of a study: what is shown and asked, by which engine, in which order, and when a track ends. Defaults are
// Kreuzer's (2017, chapter 4) with four deviations: lines on half the trials, which γ = ½ needs, a prior in the unit of the
// result, tracks of a fixed length, because observers dislike runs whose end they can't foresee, and trials at the threshold
// itself. Where an answer tells most is above it, but a track that stays there knows the threshold only through the slope
// that is assumed: with true slopes β of 2 and 5, `stairstep-analyze coverage` finds c off by −6 and +5 % there, and by less
// than 1 % with trials at the threshold, for about 2 % more error in a single track.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/engines/round_engine.h"
#include "study/trial.h"

namespace stairstep {

/// When a track ends: at `most_trials`; with `converged_sd` already from `least_trials` on, once its posterior SD is small
/// enough. 40 trials a track are 640 an observer, the thesis's 25 minutes.
struct StopRule {
    int least_trials = 10;
    int most_trials = 40;
    /// log10 units, > 0. 0.05 takes about 40 trials a track.
    std::optional<double> converged_sd;
};

/// Trials that are easy to see, apart from the tracks.
struct EasyTrials {
    /// Practice: how many before the first round.
    int practice_trials = 0;
    /// Catch trials: the chance, below ½, that a presentation of a round is one.
    double catch_share = 0;
    /// Their filter radius in texels: half of one leaves the step plain.
    double radius_texels = 0.5;
};

/// Where the observer's eyes are.
struct Viewing {
    /// From eye to screen, and from one pixel's centre to the next, mm in [1e-6, 1e9].
    double distance_mm = 600;
    double pixel_pitch_mm = 0.25;

    /// Pixels that one degree of visual angle spans at the screen's centre.
    double pixels_per_degree() const;
};

struct Design {
    std::string name = "kreuzer-2017";
    std::vector<Pattern> patterns{Pattern::step, Pattern::stair};
    std::vector<double> contrasts{1, 0.5};
    std::vector<double> texels_px{5, 10, 20, 30};
    KernelShape kernel = KernelShape::box;
    Task task = Task::yes_no;
    /// yes-no: the share of lines among a track's trials, a multiple of 0.05 within [0.05, 0.95]; γ = ½ asks for ½.
    double line_share = 0.5;
    /// Its `guess` is left to `guess_radius_texels`: T = −log10(radius/texel).
    EngineSettings engine = QuestSettings{.placement = QuestPlacement::mean};
    double guess_radius_texels = 3;
    StopRule stop;
    EasyTrials easy;
    /// A break is due after so many presentations, and before every round; 0: only before rounds.
    int break_every_trials = 0;
    /// What a display can show, px: suggestions outside are limited to it.
    double smallest_radius_px = 0.25;
    double largest_radius_px = 320;
    /// Of the picture.
    int width_px = 640;
    int height_px = 480;
    std::optional<Viewing> viewing;
};

/// Throws InputError naming the first field that is out of its range: an empty list or one of over 100, a condition twice, a share or
/// probability that can't be. `source` says where the design comes from.
void require_valid(const Design& design, const std::string& source = "design");

/// One round: tracks that run interleaved.
struct Round {
    std::vector<Condition> tracks;
};

/// The rounds of the n-th observer (from 0): one for each pattern × contrast, each with a track a texel size. Their
/// order follows a balanced Latin square, so that over observers each stands in each place, and follows each other,
/// equally often (exactly so for every even number of rounds).
std::vector<Round> rounds_for(const Design& design, int observer_index);

/// The engine's settings with the design's first guess.
EngineSettings engine_settings(const Design& design);

}  // namespace stairstep
