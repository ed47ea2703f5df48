#include "study/session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace stairstep {
namespace {

/// One adaptive sequence and what it needs to go on.
struct Track {
    int number;
    Condition condition;
    Quest quest;
    /// What the coming trials show, the next one last.
    std::vector<Judgement> upcoming;
};

bool is_finished(const Track& track, const StopRule& stop) {
    if (track.quest.trials() >= stop.most_trials) return true;
    return track.quest.trials() >= stop.least_trials && track.quest.sd() <= stop.converged_sd;
}

/// Lines on half the trials: blocks of two artifacts and two lines in random order.
Judgement next_stimulus(Track& track, Random& random) {
    if (track.upcoming.empty()) {
        track.upcoming = {Judgement::artifact, Judgement::artifact, Judgement::line, Judgement::line};
        random.shuffle(std::span(track.upcoming));
    }
    const Judgement stimulus = track.upcoming.back();
    track.upcoming.pop_back();
    return stimulus;
}

Trial run_trial(Track& track, const Design& design, Judgement stimulus, const Observer& observer) {
    Trial trial;
    trial.track = track.number;
    trial.trial = track.quest.trials() + 1;
    trial.condition = track.condition;
    trial.suggested_radius_px = track.condition.texel_px * std::pow(10.0, -track.quest.suggest());
    trial.radius_px = std::clamp(trial.suggested_radius_px, design.smallest_radius_px, design.largest_radius_px);
    trial.stimulus = stimulus;

    const Answer answer = observer({track.condition, trial.radius_px, stimulus});
    trial.response = answer.response;
    trial.response_time_s = answer.response_time_s;
    trial.shown_at_s = answer.shown_at_s;
    trial.dropped_frames = answer.dropped_frames;
    return trial;
}

}  // namespace

void run_session(const Design& design, const SessionIdentity& identity, const Observer& observer,
                 const TrialSink& record) {
    Random random(identity.seed);
    int round_number = 0;
    int track_number = 0;
    for (const Round& round : rounds_for(design, identity.observer_index)) {
        ++round_number;
        std::vector<Track> tracks;
        for (const Condition& condition : round.tracks) {
            tracks.push_back({++track_number, condition, Quest(quest_settings(design)), {}});
        }
        for (;;) {
            std::vector<Track*> open;
            for (Track& track : tracks) {
                if (!is_finished(track, design.stop)) open.push_back(&track);
            }
            if (open.empty()) break;

            Track& track = *open[random.below(open.size())];
            Trial trial = run_trial(track, design, next_stimulus(track, random), observer);
            trial.study = design.name;
            trial.observer = identity.observer;
            trial.session = identity.session;
            trial.round = round_number;
            record(trial);
            track.quest.update(std::log10(track.condition.texel_px / trial.radius_px), trial.correct());
        }
    }
}

}  // namespace stairstep
