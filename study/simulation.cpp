#include "study/simulation.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "stimuli/io/json_file.h"
#include "stimuli/io/json_object.h"

namespace stairstep {
namespace {

/// 2000-01-01T00:00:00Z: the same seed gives the same file.
constexpr double kSimulatedEpoch_s = 946684800;
constexpr double kDay_s = 86400;

std::string observer_name(int index) {
    char text[24];
    std::snprintf(text, sizeof text, "sim%02d", index + 1);
    return text;
}

SimulatedPopulation population_from(JsonObject object) {
    SimulatedPopulation p;
    object.read("step_slope", p.step_slope);
    object.read("stair_share", p.stair_share);
    object.read("half_contrast_loss", p.half_contrast_loss);
    object.read("exponent", p.exponent);
    object.read("deviation_sd", p.deviation_sd);
    object.read("between_observer_sd", p.between_observer_sd);
    object.read("common_share", p.common_share);
    object.read("beta", p.shape.beta);
    object.read("gamma", p.shape.gamma);
    object.read("delta", p.shape.delta);
    object.read("p_threshold", p.shape.p_threshold);
    object.read("response_bias", p.response_bias);
    object.read("drift", p.drift);
    object.read("fatigue", p.fatigue);
    object.read("redo_share", p.redo_share);
    object.refuse_other_keys();
    require_valid(p);
    return p;
}

}  // namespace

nlohmann::ordered_json to_json(const Simulation& simulation) {
    return {
        {"observers", simulation.observers}, {"seed", simulation.seed}, {"population", to_json(simulation.population)}};
}

Simulation simulation_from_json(const std::string& text, const std::string& source) {
    JsonObject object(parse_json(text, source), source);
    Simulation simulation;
    if (!object.contains("seed")) object.reject("seed", "is missing", "only what was simulated can go on");
    object.read("observers", simulation.observers);
    if (simulation.observers < 1) object.reject("observers", "is no number from 1 on", "restore it from a copy");
    object.read("seed", simulation.seed);
    simulation.population = population_from(object.object("population"));
    object.refuse_other_keys();
    return simulation;
}

SessionRecord session_record(const Simulation& simulation, int observer_index) {
    Random random = Random(simulation.seed).stream(static_cast<uint64_t>(observer_index));
    SessionRecord record;
    record.observer = observer_name(observer_index);
    record.observer_index = observer_index;
    record.seed = random.bits() >> 1;  // SQLite's whole numbers have a sign
    record.observer_kind = "simulated";
    record.observer_settings = to_json(simulation.population).dump();
    return record;
}

SimulatedObserver simulated_observer(const Simulation& simulation, int observer_index) {
    const Random random = Random(simulation.seed).stream(static_cast<uint64_t>(observer_index));
    return {simulation.population, random.stream(0), kSimulatedEpoch_s + observer_index * kDay_s};
}

SessionIdentity identity_of(const SessionRecord& record) {
    return {record.observer, record.observer_index, record.session, record.seed};
}

}  // namespace stairstep
