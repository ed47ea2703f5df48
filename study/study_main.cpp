// stairstep-study: runs a study, here with simulated observers, and exports its trials.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/program.h"
#include "stimuli/io/progress.h"
#include "study/session.h"
#include "study/simulated_observer.h"
#include "study/store.h"
#include "study/trials_csv.h"

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
        identity.session = store.begin_session({1, identity.observer, identity.seed, "simulated", settings, false});
        SimulatedObserver observer(options.population, random.stream(0), kSimulatedEpoch_s + i * kDay_s);
        run_session(design, identity, std::ref(observer), [&](const Trial& trial) {
            store.append(trial);
            ++trials;
            if (trial.trial == 1) progress.advance();
        });
        store.finish_session(identity.session);
    }
    std::cout << "simulated " << options.observers << " observers, " << trials << " trials, into " << options.database
              << "\n";
}

void export_trials(const std::string& database, const std::string& folder) {
    const std::vector<Trial> trials = TrialStore::open(database).trials();
    make_output_folder(folder);
    const std::filesystem::path file = std::filesystem::path(folder) / "trials.csv";
    write_file(file, trials_csv(trials));
    std::cout << "wrote " << trials.size() << " trials to " << file.string() << "\n";
}

void print_status(const std::string& database, bool as_json) {
    const TrialStore store = TrialStore::open(database);
    const std::vector<Trial> trials = store.trials();
    nlohmann::ordered_json sessions = nlohmann::ordered_json::array();
    for (const SessionRecord& session : store.sessions()) {
        const auto count = std::count_if(trials.begin(), trials.end(),
                                         [&](const Trial& trial) { return trial.session == session.session; });
        sessions.push_back({{"session", session.session},
                            {"observer", session.observer},
                            {"kind", session.observer_kind},
                            {"trials", count},
                            {"finished", session.finished}});
    }
    if (as_json) {
        std::cout << nlohmann::ordered_json{{"study", store.study()}, {"trials", trials.size()}, {"sessions", sessions}}
                         .dump(2)
                  << "\n";
        return;
    }
    std::cout << "study " << store.study() << ": " << trials.size() << " trials\n";
    for (const auto& session : sessions) {
        std::cout << "  session " << session["session"] << "  " << session["observer"].get<std::string>() << "  "
                  << session["trials"] << " trials  " << (session["finished"] ? "finished" : "not finished") << "\n";
    }
}

}  // namespace
}  // namespace stairstep

int main(int argc, char** argv) {
    using namespace stairstep;
    CLI::App app("Runs a study of how much filtering hides shadow-map texels.", "stairstep-study");
    app.require_subcommand(1);

    SimulateOptions simulation;
    auto* simulate_command = app.add_subcommand("simulate", "Run the study with simulated observers.");
    simulate_command->add_option("--observers", simulation.observers, "how many")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    simulate_command->add_option("--seed", simulation.seed, "same seed, same study")->capture_default_str();
    simulate_command->add_option("--db", simulation.database, "the new database")->required();
    simulate_command
        ->add_option("--law-slope", simulation.population.step_slope,
                     "median true c of the step at full contrast; the stair's is 2.5/3.47 of it")
        ->capture_default_str();
    simulate_command
        ->add_option("--between-observer-sd", simulation.population.between_observer_sd, "SD of ln c between observers")
        ->capture_default_str();
    simulate_command->add_option("--lapse", simulation.population.shape.delta, "share of blind answers")
        ->capture_default_str();
    simulate_command->callback([&] { simulate(simulation); });

    std::string database;
    std::string folder;
    bool as_json = false;
    auto* export_command = app.add_subcommand("export", "Write the trials as trials.csv.");
    export_command->add_option("--db", database, "the study's database")->required();
    export_command->add_option("--out", folder, "folder for trials.csv")->required();
    export_command->add_option("--format")->check(CLI::IsMember({"csv"}))->default_str("csv");
    export_command->callback([&] { export_trials(database, folder); });

    auto* status_command = app.add_subcommand("status", "Say what a database holds.");
    status_command->add_option("--db", database, "the study's database")->required();
    status_command->add_flag("--json", as_json, "print JSON");
    status_command->callback([&] { print_status(database, as_json); });

    return run_program(app, argc, argv);
}
