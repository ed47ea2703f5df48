// A trial: what was shown and what the observer said. The columns of trials.csv and of the store.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "stimuli/edge.h"
#include "stimuli/kernel.h"

namespace stairstep {

/// What a trial shows, and what an observer says of it: the silhouette sampled by a shadow map, or a true line.
enum class Judgement { artifact, line };

std::string_view name(Judgement judgement);
std::optional<Judgement> judgement_named(std::string_view name);

/// What an adaptive track holds fixed.
struct Condition {
    /// step or stair; on a line trial, whose line it is.
    Pattern pattern = Pattern::step;
    KernelShape kernel = KernelShape::box;
    double contrast = 1;
    double texel_px = 10;

    bool operator==(const Condition&) const = default;
};

struct Trial {
    std::string study;
    std::string observer;
    /// Numbers from 1: session in the store, round in the session, track in the session, trial in the track.
    int session = 1;
    int round = 1;
    int track = 1;
    int trial = 1;
    Condition condition;
    /// What the engine asked for, and what was shown after limiting it to what the display can show, px.
    double suggested_radius_px = 0;
    double radius_px = 0;
    Judgement stimulus = Judgement::artifact;
    Judgement response = Judgement::artifact;
    /// From onset to answer, s.
    double response_time_s = 0;
    /// Onset, Unix time, s.
    double shown_at_s = 0;
    int dropped_frames = 0;

    bool correct() const { return stimulus == response; }
};

}  // namespace stairstep
