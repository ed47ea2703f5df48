// An observer answers what a trial shows: a person at a screen, a script, or a simulation. One function type for all.
#pragma once

#include <functional>
#include <string>

#include "study/trial.h"

namespace stairstep {

/// What is put before an observer.
struct Presentation {
    Condition condition;
    double radius_px = 0;
    Judgement stimulus = Judgement::artifact;
};

struct Answer {
    Judgement response = Judgement::artifact;
    double response_time_s = 0;
    /// Onset, Unix time, s.
    double shown_at_s = 0;
    int dropped_frames = 0;
};

using Observer = std::function<Answer(const Presentation&)>;

}  // namespace stairstep
