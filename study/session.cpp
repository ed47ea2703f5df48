#include "study/session.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// Streams of chance: one for each presentation from 1 on, and beyond them one for each round's engines and one for each
/// deck of a track's coming stimuli.
constexpr uint64_t kFirstEngineStream = uint64_t{1} << 36;
constexpr uint64_t kFirstDeckStream = uint64_t{1} << 40;
constexpr uint64_t kDecksPerTrack = uint64_t{1} << 20;

/// The least number of trials, at least four, that a share divides without remainder.
int deck_size(double line_share) {
    for (int size = 4; size < 20; ++size) {
        const double lines = size * line_share;
        if (std::abs(lines - std::round(lines)) < 1e-9) return size;
    }
    return 20;
}

bool is_close(double a, double b) {
    return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

}  // namespace

Session::Session(const Design& design, const SessionIdentity& identity) : design_(design), identity_(identity) {
    require_valid(design_);
    rounds_ = rounds_for(design_, identity_.observer_index);
    begin_round();
    plan();
}

void Session::begin_round() {
    first_track_ = tracks_.size();
    const std::vector<Condition>& conditions = rounds_[round_].tracks;
    const uint64_t engine_seed = Random(identity_.seed).stream(kFirstEngineStream + round_).bits();
    engine_.emplace(engine_settings(design_), conditions.size(), engine_seed);
    prior_sd_ = engine_->estimate(0).sd;
    for (size_t k = 0; k < conditions.size(); ++k) {
        tracks_.push_back({static_cast<int>(round_) + 1, conditions[k], engine_->estimate(k), 0, false});
    }
}

void Session::apply(const Trial& trial) {
    if (trial.kind == TrialKind::practice) ++practised_;
    if (trial.kind != TrialKind::main) return;
    const size_t answered = static_cast<size_t>(trial.track) - 1;
    engine_->update(answered - first_track_, trial.strength(), trial.correct());
    const StopRule& stop = design_.stop;
    bool all_finished = true;
    for (size_t k = first_track_; k < tracks_.size(); ++k) {
        TrackState& track = tracks_[k];
        if (k == answered || engine_->shares_evidence()) track.estimate = engine_->estimate(k - first_track_);
        track.trials = engine_->trials(k - first_track_);
        const bool converged =
            stop.converged_sd && track.trials >= stop.least_trials && track.estimate.sd <= *stop.converged_sd;
        track.is_finished = track.is_finished || converged || track.trials >= stop.most_trials;
        all_finished = all_finished && track.is_finished;
    }
    if (!all_finished) return;
    if (++round_ < rounds_.size()) {
        begin_round();
    } else {
        engine_.reset();
    }
}

Judgement Session::deck_card(size_t track, int index) const {
    const int size = deck_size(design_.line_share);
    const int lines = static_cast<int>(std::lround(size * design_.line_share));
    std::vector<Judgement> deck(static_cast<size_t>(size), Judgement::artifact);
    std::fill_n(deck.begin(), lines, Judgement::line);
    const uint64_t stream = kFirstDeckStream + track * kDecksPerTrack + static_cast<uint64_t>(index / size);
    Random(identity_.seed).stream(stream).shuffle(std::span(deck));
    return deck[static_cast<size_t>(index % size)];
}

void Session::plan() {
    next_.reset();
    if (!engine_) return;
    Random random = Random(identity_.seed).stream(static_cast<uint64_t>(presentations_) + 1);
    const std::vector<Condition>& conditions = rounds_[round_].tracks;
    const auto any_stimulus = [&] {
        const double line_share = design_.task == Task::yes_no ? design_.line_share : 0.5;
        return random.uniform() < line_share ? Judgement::line : Judgement::artifact;
    };

    Trial trial;
    size_t track = 0;
    if (practised_ < design_.easy.practice_trials) {
        trial.kind = TrialKind::practice;
        track = static_cast<size_t>(practised_) % conditions.size();
        trial.stimulus = any_stimulus();
    } else if (design_.easy.catch_share > 0 && random.uniform() < design_.easy.catch_share) {
        trial.kind = TrialKind::attention;
        track = random.below(conditions.size());
        trial.stimulus = any_stimulus();
    } else {
        std::vector<bool> open;
        for (size_t k = first_track_; k < tracks_.size(); ++k) open.push_back(!tracks_[k].is_finished);
        const Placement placement = engine_->suggest(open, random.stream(0));
        track = placement.track;
        trial.trial = tracks_[first_track_ + track].trials + 1;
        trial.suggested_radius_px = conditions[track].texel_px * std::pow(10.0, -placement.intensity);
        trial.stimulus = deck_card(first_track_ + track, trial.trial - 1);
    }
    if (trial.kind != TrialKind::main) {
        trial.trial = 0;
        trial.suggested_radius_px = conditions[track].texel_px * design_.easy.radius_texels;
    }
    trial.study = design_.name;
    trial.observer = identity_.observer;
    trial.session = identity_.session;
    trial.presentation = presentations_ + 1;
    trial.round = static_cast<int>(round_) + 1;
    trial.track = static_cast<int>(first_track_ + track) + 1;
    trial.task = design_.task;
    trial.condition = conditions[track];
    trial.radius_px = std::clamp(trial.suggested_radius_px, design_.smallest_radius_px, design_.largest_radius_px);
    next_ = trial;
}

void Session::record(const Trial& answered) {
    since_break_ = break_is_due() ? 1 : since_break_ + 1;
    last_round_shown_ = answered.round;
    ++presentations_;
    can_void_ = !answered.is_void;
    if (!answered.is_void) {
        counted_.push_back(answered);
        apply(answered);
    }
    plan();
}

void Session::void_last() {
    assert(can_void_);
    can_void_ = false;
    counted_.pop_back();
    // Engines can't unlearn: go through what counts again.
    tracks_.clear();
    round_ = 0;
    practised_ = 0;
    begin_round();
    for (const Trial& trial : counted_) apply(trial);
    plan();
}

bool Session::break_is_due() const {
    if (!next_) return false;
    if (design_.break_every_trials > 0 && since_break_ >= design_.break_every_trials) return true;
    return next_->round > last_round_shown_;
}

double Session::track_progress(const TrackState& track) const {
    if (track.is_finished) return 1;
    const StopRule& stop = design_.stop;
    double share = static_cast<double>(track.trials) / stop.most_trials;
    if (stop.converged_sd && *stop.converged_sd < prior_sd_) {
        // Each trial adds about as much to 1/SD² as the next.
        const auto gained = [this](double sd) { return 1 / (sd * sd) - 1 / (prior_sd_ * prior_sd_); };
        const double learnt = gained(track.estimate.sd) / gained(*stop.converged_sd);
        share = std::max(share, std::min(learnt, static_cast<double>(track.trials) / stop.least_trials));
    }
    return std::clamp(share, 0.0, 0.99);
}

double Session::progress() const {
    double done = 0;
    for (const TrackState& track : tracks_) done += track_progress(track);
    return done / static_cast<double>(rounds_.size() * rounds_[0].tracks.size());
}

SessionOutcome run_session(Session& session, const Observer& observer, const SessionLog& log) {
    while (session.next()) {
        Trial trial = *session.next();
        const int since_break = session.break_is_due() ? 0 : session.since_break();
        const Answer answer = observer({trial.condition, trial.radius_px, trial.stimulus, trial.task,
                                        trial.presentation, since_break, session.can_void_last()});
        switch (answer.action) {
            case Action::pause: return SessionOutcome::paused;
            case Action::abort: return SessionOutcome::aborted;
            case Action::redo_last:
                if (session.can_void_last()) {
                    log.mark_void(trial.presentation - 1);
                    session.void_last();
                    log.learnt();
                }
                continue;
            case Action::answer: break;
        }
        trial.response = answer.response;
        trial.response_time_s = answer.response_time_s;
        trial.shown_at_s = answer.shown_at_s;
        trial.dropped_frames = answer.dropped_frames;
        log.record(trial);
        session.record(trial);
        log.learnt();
    }
    return SessionOutcome::finished;
}

Session resumed_session(const Design& design, const SessionIdentity& identity, const std::vector<Trial>& trials,
                        const std::string& source) {
    Session session(design, identity);
    for (const Trial& trial : trials) {
        const std::string place = source + ": session " + std::to_string(identity.session) + ", presentation " +
                                  std::to_string(trial.presentation);
        const auto require = [&place](bool holds, const char* problem) {
            if (!holds) {
                throw InputError(place, problem, "go on with the design and version of Stairstep that recorded it");
            }
        };
        require(session.next().has_value(), "comes after the session's end");
        const Trial& planned = *session.next();
        require(trial.presentation == planned.presentation, "is out of order");
        require(trial.round == planned.round && trial.track == planned.track && trial.trial == planned.trial &&
                    trial.kind == planned.kind && trial.condition == planned.condition && trial.task == planned.task,
                "isn't the trial that the design has here");
        require(trial.stimulus == planned.stimulus, "shows another stimulus than the design has here");
        require(is_close(trial.suggested_radius_px, planned.suggested_radius_px) &&
                    is_close(trial.radius_px, planned.radius_px),
                "has another radius than its engine suggests");
        session.record(trial);
    }
    return session;
}

}  // namespace stairstep
