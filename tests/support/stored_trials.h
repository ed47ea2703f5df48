// Trials for tests that only store them: unlike each other, and known by their numbers.
#pragma once

#include "study/store.h"

namespace stairstep {

inline Trial some_trial(int session, int number) {
    Trial trial;
    trial.study = "s";
    trial.observer = "o1";
    trial.session = session;
    trial.track = 3;
    trial.trial = number;
    trial.presentation = number;
    trial.condition = {Pattern::stair, KernelShape::box, 0.5, 20};
    trial.suggested_radius_px = 50.1;
    trial.radius_px = 50.1 / number;
    trial.stimulus = Judgement::line;
    trial.response = number % 2 == 0 ? Judgement::line : Judgement::artifact;
    trial.response_time_s = 0.75;
    trial.shown_at_s = 946684800.25 + number;
    trial.dropped_frames = 1;
    return trial;
}

inline SessionRecord some_session() {
    SessionRecord session;
    session.observer = "o1";
    session.seed = 42;
    session.observer_kind = "simulated";
    session.observer_settings = "{}";
    return session;
}

}  // namespace stairstep
