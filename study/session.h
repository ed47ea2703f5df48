// A session: one observer goes through the rounds of a design. Reads as a trial: plan, show, answer, record, learn.
//
// `Session` is a value that knows neither clock nor file nor observer: what comes next is a function of the design, the
// session's identity and the trials so far. Chance enters by presentation: the n-th draws from a stream of its own, so that
// a session rebuilt from its records plans on exactly as the one that wrote them would have.
#pragma once

#include <functional>
#include <optional>
#include <vector>

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

/// Where a track stands.
struct TrackState {
    int round = 1;
    Condition condition;
    ThresholdEstimate estimate;
    int trials = 0;
    bool is_finished = false;
};

class Session {
  public:
    /// Throws InputError for a design that isn't valid.
    Session(const Design& design, const SessionIdentity& identity);

    /// The trial to show now, without its answer; none when all rounds are done.
    const std::optional<Trial>& next() const { return next_; }

    /// Takes in `next()` with its answer. One that is void, because it was taken back already, only counts as shown: the same
    /// as `record` and `void_last`, without what undoing costs.
    void record(const Trial& answered);

    /// Whether there is a last trial, and it wasn't taken back already.
    bool can_void_last() const { return can_void_; }
    /// Takes the last trial back, which must be possible: it will be shown anew, at a later presentation.
    void void_last();

    /// Whether the observer should rest before `next()`.
    bool break_is_due() const;
    /// Presentations since the session's start or last break.
    int since_break() const { return since_break_; }

    /// All tracks in the order of their numbers, from 1.
    const std::vector<TrackState>& tracks() const { return tracks_; }

    /// Share of the session that is done, [0, 1]; where tracks may converge early, as far as one can tell.
    double progress() const;

  private:
    void begin_round();
    void apply(const Trial& trial);
    void plan();
    Judgement deck_card(size_t track, int index) const;
    double track_progress(const TrackState& track) const;

    Design design_;
    SessionIdentity identity_;
    std::vector<Round> rounds_;
    std::vector<TrackState> tracks_;
    /// Tracks before the current round, and the round's own engine; none after the last round.
    size_t first_track_ = 0;
    size_t round_ = 0;
    std::optional<RoundEngine> engine_;
    double prior_sd_ = 0;
    int practised_ = 0;
    int presentations_ = 0;
    int since_break_ = 0;
    int last_round_shown_ = 1;
    /// What is not taken back.
    std::vector<Trial> counted_;
    bool can_void_ = false;
    std::optional<Trial> next_;
};

/// Where a session's trials go. Each call returns when what it records is safe.
struct SessionLog {
    std::function<void(const Trial&)> record = [](const Trial&) {};
    /// The trial of this presentation is taken back.
    std::function<void(int presentation)> mark_void = [](int) {};
    /// The session has taken in what was recorded, or marked, just before.
    std::function<void()> learnt = [] {};
};

enum class SessionOutcome { finished, paused, aborted };

/// Goes on with a session until it is through, or the observer stops. Throws what the observer or the log throws; trials
/// recorded before stay recorded.
SessionOutcome run_session(Session& session, const Observer& observer, const SessionLog& log = {});

/// A session as it stood when the last of these trials had been recorded: all of one session, in the order of their
/// presentation, void ones included. Throws InputError, with `source` as its subject, where they aren't what this design and
/// identity would have shown (radii may differ by rounding).
Session resumed_session(const Design& design, const SessionIdentity& identity, const std::vector<Trial>& trials,
                        const std::string& source);

}  // namespace stairstep
