#include "analysis/planted_study.h"

#include "study/design_json.h"
#include "study/session.h"
#include "study/simulation.h"
#include "study/store.h"

#include <nlohmann/json.hpp>

namespace stairstep {

std::vector<Trial> simulate_study(const PlantedStudy& study, uint64_t seed) {
    const Simulation simulation{study.observers, seed, study.population};
    TrialStore store = TrialStore::create(":memory:", study.design.name, to_json(study.design).dump());
    for (int i = 0; i < study.observers; ++i) {
        SessionRecord record = session_record(simulation, i);
        record.session = store.begin_session(record);
        Session session(study.design, identity_of(record));
        run_session(session, simulated_observer(simulation, i),
                    {.record = [&](const Trial& trial) { store.append(trial); },
                     .mark_void = [&](int presentation) { store.mark_void(record.session, presentation); }});
        store.end_session(record.session, SessionEnd::finished);
    }
    return evidence(store.trials());
}

}  // namespace stairstep
