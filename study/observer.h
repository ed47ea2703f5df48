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
    Task task = Task::yes_no;
    /// From 1 in the session; a simulated observer's answer depends on it and not on calls made before.
    int number = 1;
    /// Presentations since the session's start or last break.
    int since_break = 0;
    /// Whether there is an answer that can be taken back.
    bool may_redo = false;
};

/// What an observer does when shown something: says what it is, takes the last answer back (which leaves this presentation
/// unanswered), stops for now, or stops for good.
enum class Action { answer, redo_last, pause, abort };

struct Answer {
    Judgement response = Judgement::artifact;
    double response_time_s = 0;
    /// Onset, Unix time, s.
    double shown_at_s = 0;
    int dropped_frames = 0;
    Action action = Action::answer;
};

using Observer = std::function<Answer(const Presentation&)>;

}  // namespace stairstep
