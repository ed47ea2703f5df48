// Where the sessions of a study stand: how far they are, how sure of their thresholds, how long they will take, and whether
// their observers attend.
//
// A session is rebuilt from its records (`resumed_session`). How good an estimate is, is told by its posterior SD over the
// smallest one that so many trials allow, the Fisher bound
//
//   SD_bound = 1/√(n·I* + 1/σ₀²),
//
// I* the information of the best possible trial (study/engines/quest.h), σ₀ the prior's SD: 1 is as good as can be; QUEST's 40
// trials reach about 1.5 (SD .056 against .0374). Single tracks may lie below 1, as do engines that learn about one track
// from the trials of others.
//
// Time left: the median time from one onset to the next, which breaks don't move, times the presentations that are left;
// these from the session's own share of void, catch and main trials so far and from `Session::progress`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/session.h"
#include "study/store.h"

namespace stairstep {

/// SD_bound after n ≥ 0 trials, log10 units; none for an engine without a psychometric shape and a prior of T. 0.0374 for QUEST's
/// defaults at n = 40.
std::optional<double> fisher_bound_sd(const EngineSettings& engine, int trials);

struct TrackStatus {
    /// From 1, in the session.
    int track = 1;
    TrackState state;
    std::optional<double> bound_sd;

    /// SD over bound; none before the first trial.
    std::optional<double> sd_over_bound() const;
};

/// What rebuilding a session tells.
struct SessionProgress {
    int rounds = 0;
    int rounds_done = 0;
    int tracks = 0;
    int tracks_done = 0;
    /// Main trials, without void ones, that the whole session will have.
    int expected_trials = 0;
    /// Share that is done, [0, 1].
    double share = 0;
    /// Of the rounds begun so far.
    std::vector<TrackStatus> begun;
    /// Median over tracks with trials.
    std::optional<double> sd_over_bound;
    /// s; none before the second presentation or the first main trial, and where the session has ended.
    std::optional<double> time_left_s;
};

struct SessionStatus {
    SessionRecord session;
    /// All, void ones included.
    int presentations = 0;
    int voids = 0;
    /// Without void ones.
    int main_trials = 0;
    int practice_trials = 0;
    int catch_trials = 0;
    int catch_right = 0;
    /// Median time from one onset to the next, s; none before the second.
    std::optional<double> presentation_s;
    /// None where the session can't be rebuilt; `note` says why.
    std::optional<SessionProgress> progress;
    std::string note;
};

/// The status of each session; `trials` in the order of recording. `source` names the database in notes. Throws nothing of
/// its own: a design that can't be read, or a session that it didn't give, ends in notes. Sessions are rebuilt in parallel.
std::vector<SessionStatus> study_status(const std::string& design_json, const std::vector<SessionRecord>& sessions,
                                        const std::vector<Trial>& trials, const std::string& source);

}  // namespace stairstep
