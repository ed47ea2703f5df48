// A session: one observer goes through the rounds of a design. Reads as a trial: suggest, show, answer, record, learn.
#pragma once

#include <functional>

#include "stimuli/random.h"
#include "study/design.h"
#include "study/observer.h"

namespace stairstep {

struct SessionIdentity {
    std::string observer;
    /// From 0; decides the order of the rounds.
    int observer_index = 0;
    /// From 1, in the store.
    int session = 1;
    /// Decides everything the session leaves to chance: which track comes next, and which trials are lines.
    uint64_t seed = 1;
};

/// Called with each finished trial, before the next is suggested; returns when the trial is safe.
using TrialSink = std::function<void(const Trial&)>;

/// Runs all rounds. The number of trials done is at most tracks × most_trials.
/// Throws what the observer or the sink throws; trials recorded before stay recorded.
void run_session(const Design& design, const SessionIdentity& identity, const Observer& observer,
                 const TrialSink& record);

}  // namespace stairstep
