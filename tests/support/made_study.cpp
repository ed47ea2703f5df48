#include "tests/support/made_study.h"

#include <nlohmann/json.hpp>

#include "study/design_json.h"
#include "study/session.h"
#include "study/simulated_observer.h"

namespace stairstep {
namespace {

/// Goes through a session until it is over or `most` presentations were answered.
std::vector<Trial> session_trials(const Design& design, const SessionRecord& record, int most) {
    SimulatedPopulation population;
    population.redo_share = 0.2;
    const SimulatedObserver simulated(population, Random(record.seed), 946684800 + record.session * 1e5);
    std::vector<Trial> trials;
    Session session(design, {record.observer, record.observer_index, record.session, record.seed});
    const Observer observer = [&](const Presentation& presentation) {
        Answer answer = simulated(presentation);
        if (presentation.number > most) answer.action = Action::pause;
        return answer;
    };
    run_session(session, observer,
                {[&](const Trial& trial) { trials.push_back(trial); },
                 [&](int presentation) { trials[static_cast<size_t>(presentation) - 1].is_void = true; }});
    return trials;
}

}  // namespace

MadeStudy made_study() {
    MadeStudy study;
    study.design.name = "pilot 1";
    study.design.contrasts = {1};
    study.design.texels_px = {10, 20};
    study.design.stop = {2, 6, std::nullopt};
    study.design.easy = {.practice_trials = 2, .catch_share = 0.2};
    study.design.viewing = Viewing{600, 0.25};
    study.sessions = {{1, "Anna Meier", 0, 11, "person", "{}", SessionEnd::finished},
                      {2, "sub-07", 1, 12, "person", "{}", SessionEnd::aborted},
                      {3, "Anna Meier", 0, 13, "person", "{}", std::nullopt},
                      {4, "sim01", 2, 14, "simulated", "{}", SessionEnd::finished},
                      {5, "Öz", 3, 15, "person", "{}", std::nullopt}};
    constexpr int kMost[] = {1000, 9, 20, 1000, 0};
    for (size_t i = 0; i < study.sessions.size(); ++i) {
        const auto trials = session_trials(study.design, study.sessions[i], kMost[i]);
        study.trials.insert(study.trials.end(), trials.begin(), trials.end());
    }
    return study;
}

void write_study(const std::filesystem::path& path, const MadeStudy& study) {
    TrialStore store = TrialStore::create(path, study.design.name, to_json(study.design).dump());
    for (const SessionRecord& session : study.sessions) store.begin_session(session);
    for (const Trial& trial : study.trials) {
        store.append(trial);
        if (trial.is_void) store.mark_void(trial.session, trial.presentation);
    }
    for (const SessionRecord& session : study.sessions) {
        if (session.end) store.end_session(session.session, *session.end);
    }
}

}  // namespace stairstep
