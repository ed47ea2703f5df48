// A simulated study: how many observers of which population, drawn from which seed. The plan that a database keeps, so that a
// simulation that was interrupted can go on to the same result.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/session.h"
#include "study/simulated_observer.h"
#include "study/store.h"

namespace stairstep {

struct Simulation {
    /// How many, ≥ 1; each goes through one session.
    int observers = 10;
    /// Same seed, same study: observer n depends on it and on n alone, not on how many there are.
    uint64_t seed = 1;
    SimulatedPopulation population;
};

nlohmann::ordered_json to_json(const Simulation& simulation);

/// Throws InputError, naming source and key, for what no `to_json` writes, and as `require_valid` of the population.
Simulation simulation_from_json(const std::string& text, const std::string& source);

/// The session of the n-th observer (from 0), before the store gives it a number.
SessionRecord session_record(const Simulation& simulation, int observer_index);

/// The n-th observer. Simulated clocks start at 2000-01-01T00:00:00Z, a day a session.
SimulatedObserver simulated_observer(const Simulation& simulation, int observer_index);

/// The identity under which a recorded session runs.
SessionIdentity identity_of(const SessionRecord& record);

}  // namespace stairstep
