#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "stimuli/io/progress.h"
#include "study/commands/commands.h"
#include "study/design_json.h"
#include "study/session.h"
#include "study/simulated_observer.h"
#include "study/store.h"

namespace stairstep {
namespace {

/// Simulated clocks start here, so that the same seed gives the same file: 2000-01-01T00:00:00Z, a day a session.
constexpr double kSimulatedEpoch_s = 946684800;
constexpr double kDay_s = 86400;

struct SimulateOptions {
    int observers = 10;
    uint64_t seed = 1;
    std::string database;
    SimulatedPopulation population;
};

std::string observer_name(int index) {
    char text[24];
    std::snprintf(text, sizeof text, "sim%02d", index + 1);
    return text;
}

void simulate(const SimulateOptions& options) {
    require_valid(options.population);
    const Design design;
    TrialStore store = TrialStore::create(options.database, design.name, to_json(design).dump());
    const std::string settings = to_json(options.population).dump();

    const long tracks = static_cast<long>(design.patterns.size() * design.contrasts.size() * design.texels_px.size());
    Progress progress("simulating observers' tracks", options.observers * tracks);
    long trials = 0;
    for (int i = 0; i < options.observers; ++i) {
        Random random = Random(options.seed).stream(static_cast<uint64_t>(i));
        SessionIdentity identity{observer_name(i), i, 1, random.bits() >> 1};
        identity.session =
            store.begin_session({1, identity.observer, i, identity.seed, "simulated", settings, std::nullopt});
        const SimulatedObserver observer(options.population, random.stream(0), kSimulatedEpoch_s + i * kDay_s);
        Session session(design, identity);
        run_session(session, observer,
                    {[&](const Trial& trial) {
                         store.append(trial);
                         ++trials;
                         if (trial.trial == 1) progress.advance();
                     },
                     [&](int presentation) { store.mark_void(identity.session, presentation); }});
        store.end_session(identity.session, SessionEnd::finished);
    }
    std::cout << "simulated " << options.observers << " observers, " << trials << " trials, into " << options.database
              << "\n";
}

}  // namespace

void add_simulate_command(CLI::App& app) {
    auto* command = app.add_subcommand("simulate", "Run the study with simulated observers.");
    const auto options = std::make_shared<SimulateOptions>();
    command->add_option("--observers", options->observers, "how many")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command->add_option("--seed", options->seed, "same seed, same study")->capture_default_str();
    command->add_option("--db", options->database, "the new database")->required();
    command
        ->add_option("--law-slope", options->population.step_slope,
                     "median true c of the step at full contrast; the stair's is 2.5/3.47 of it")
        ->capture_default_str();
    command
        ->add_option("--between-observer-sd", options->population.between_observer_sd, "SD of ln c between observers")
        ->capture_default_str();
    command->add_option("--lapse", options->population.shape.delta, "share of blind answers")->capture_default_str();
    command->callback([options] { simulate(*options); });
}

}  // namespace stairstep
