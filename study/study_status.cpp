#include "study/study_status.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "stimuli/error.h"
#include "stimuli/parallel.h"
#include "study/design_json.h"

namespace stairstep {
namespace {

std::optional<double> median(std::vector<double> values) {
    if (values.empty()) return std::nullopt;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::optional<double> pace_s(const std::vector<Trial>& trials) {
    std::vector<double> gaps_s;
    for (size_t i = 1; i < trials.size(); ++i) gaps_s.push_back(trials[i].shown_at_s - trials[i - 1].shown_at_s);
    return median(gaps_s);
}

SessionStatus counted(const SessionRecord& session, const std::vector<Trial>& trials) {
    SessionStatus status;
    status.session = session;
    status.presentations = static_cast<int>(trials.size());
    for (const Trial& trial : trials) {
        if (trial.is_void) {
            ++status.voids;
            continue;
        }
        status.main_trials += trial.kind == TrialKind::main;
        status.practice_trials += trial.kind == TrialKind::practice;
        status.catch_trials += trial.kind == TrialKind::attention;
        status.catch_right += trial.kind == TrialKind::attention && trial.correct();
    }
    status.presentation_s = pace_s(trials);
    return status;
}

/// Of a session that goes on; nothing is known before its rounds have begun.
std::optional<double> time_left_s(const SessionStatus& status, double share) {
    if (!status.presentation_s || !(share > 0)) return std::nullopt;
    const int in_rounds = status.presentations - status.practice_trials;
    return *status.presentation_s * in_rounds * (1 - share) / share;
}

SessionProgress progress_of(const Session& session, const Design& design, const SessionStatus& status) {
    SessionProgress progress;
    const std::vector<Round> rounds = rounds_for(design, status.session.observer_index);
    progress.rounds = static_cast<int>(rounds.size());
    for (const Round& round : rounds) progress.tracks += static_cast<int>(round.tracks.size());
    std::vector<double> ratios;
    for (const TrackState& state : session.tracks()) {
        const int number = static_cast<int>(progress.begun.size()) + 1;
        progress.begun.push_back({number, state, fisher_bound_sd(design.engine, state.trials)});
        progress.tracks_done += state.is_finished;
        if (const auto ratio = progress.begun.back().sd_over_bound()) ratios.push_back(*ratio);
    }
    progress.rounds_done = session.next() ? session.tracks().back().round - 1 : progress.rounds;
    progress.sd_over_bound = median(ratios);
    progress.share = session.progress();
    progress.expected_trials = progress.share > 0 ? static_cast<int>(std::lround(status.main_trials / progress.share))
                                                  : progress.tracks * design.stop.most_trials;
    if (!status.session.end) progress.time_left_s = time_left_s(status, progress.share);
    return progress;
}

}  // namespace

std::optional<double> fisher_bound_sd(const EngineSettings& engine, int trials) {
    const QuestSettings* model = known_shape_model(engine);
    if (!model) return std::nullopt;
    const double prior = 1 / (model->guess_sd * model->guess_sd);
    return 1 / std::sqrt(trials * largest_information(model->shape) + prior);
}

std::optional<double> TrackStatus::sd_over_bound() const {
    if (state.trials == 0 || !bound_sd) return std::nullopt;
    return state.estimate.sd / *bound_sd;
}

std::vector<SessionStatus> study_status(const std::string& design_json, const std::vector<SessionRecord>& sessions,
                                        const std::vector<Trial>& trials, const std::string& source) {
    std::map<int, std::vector<Trial>> session_trials;
    for (const Trial& trial : trials) session_trials[trial.session].push_back(trial);
    std::vector<SessionStatus> result;
    for (const SessionRecord& session : sessions) result.push_back(counted(session, session_trials[session.session]));

    std::optional<Design> design;
    try {
        design = design_from_json(design_json, source + ": design");
    } catch (const InputError& error) {
        for (SessionStatus& status : result) status.note = error.what();
        return result;
    }
    run_in_parallel(result.size(), 0, [&](size_t i) {
        SessionStatus& status = result[i];
        const SessionRecord& record = status.session;
        try {
            const Session session =
                resumed_session(*design, {record.observer, record.observer_index, record.session, record.seed},
                                session_trials.at(record.session), source);
            status.progress = progress_of(session, *design, status);
        } catch (const InputError& error) {
            status.note = error.what();
        }
    });
    return result;
}

}  // namespace stairstep
