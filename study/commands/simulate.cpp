#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "stimuli/error.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"
#include "study/commands/commands.h"
#include "study/database_file.h"
#include "study/design_json.h"
#include "study/session.h"
#include "study/simulation.h"
#include "study/store.h"
#include "study/writer_lock.h"

namespace stairstep {
namespace {

struct PopulationFlag {
    const char* name;
    const char* help;
    double& (*field)(SimulatedPopulation&);
};

constexpr PopulationFlag kPopulationFlags[] = {
    {"--law-slope", "median true c of the step at full contrast; the stair's is 2.5/3.47 of it",
     [](SimulatedPopulation& p) -> double& { return p.step_slope; }},
    {"--between-observer-sd", "SD of ln c between observers",
     [](SimulatedPopulation& p) -> double& { return p.between_observer_sd; }},
    {"--exponent", "p of r = c 10 px (a/10 px)^p; 1 is the law",
     [](SimulatedPopulation& p) -> double& { return p.exponent; }},
    {"--deviation-sd", "SD of ln r between an observer's texel sizes, beyond the law",
     [](SimulatedPopulation& p) -> double& { return p.deviation_sd; }},
    {"--lapse", "share of blind answers", [](SimulatedPopulation& p) -> double& { return p.shape.delta; }},
    {"--beta", "steepness of the observers' psychometric function",
     [](SimulatedPopulation& p) -> double& { return p.shape.beta; }},
    {"--bias", "who sees nothing says \"artifact\" with probability 1/2 + bias",
     [](SimulatedPopulation& p) -> double& { return p.response_bias; }},
    {"--drift", "log10 units by which the task gets harder every 100 presentations",
     [](SimulatedPopulation& p) -> double& { return p.drift; }},
    {"--fatigue", "how much the share of blind answers grows every 100 presentations without a break",
     [](SimulatedPopulation& p) -> double& { return p.fatigue; }},
    {"--redo", "share of answers that are taken back at once",
     [](SimulatedPopulation& p) -> double& { return p.redo_share; }},
};

struct SimulateOptions {
    std::string database;
    std::string design_file;
    Simulation asked;
    bool json_lines = false;
    bool resume = false;
    CLI::App* command = nullptr;

    bool given(const std::string& flag) const { return command->count(flag) > 0; }
};

/// A database and what is being simulated into it.
struct Job {
    TrialStore store;
    /// Against a second simulation into the same database, which would begin the same observers; none in memory.
    std::optional<WriterLock> lock;
    Design design;
    Simulation simulation;
};

constexpr const char* kContradiction = "leave it out to go on, or name another --db";

/// The stored plan, once the flags that were given agree with it. More observers than were planned are welcome.
Simulation agreed_simulation(const SimulateOptions& options, Simulation stored) {
    const auto refuse = [](const std::string& flag, const std::string& asked, const std::string& begun_with) {
        throw InputError(flag + " " + asked, "the database was begun with " + begun_with, kContradiction);
    };
    Simulation asked = options.asked;
    for (const PopulationFlag& flag : kPopulationFlags) {
        const double value = flag.field(asked.population);
        const double begun_with = flag.field(stored.population);
        if (options.given(flag.name) && value != begun_with) {
            refuse(flag.name, format_number(value), format_number(begun_with));
        }
    }
    if (options.given("--seed") && asked.seed != stored.seed) {
        refuse("--seed", std::to_string(asked.seed), std::to_string(stored.seed));
    }
    if (options.given("--observers")) {
        if (asked.observers < stored.observers) {
            refuse("--observers", std::to_string(asked.observers), std::to_string(stored.observers));
        }
        stored.observers = asked.observers;
    }
    return stored;
}

Job begin_job(const SimulateOptions& options) {
    const Design design = options.design_file.empty() ? Design{} : read_design(options.design_file);
    require_valid(options.asked.population);
    TrialStore store =
        TrialStore::create(options.database, design.name, to_json(design).dump(), to_json(options.asked).dump());
    std::optional<WriterLock> lock;
    if (!is_in_memory(options.database)) lock.emplace(options.database, "simulation");
    return {std::move(store), std::move(lock), design, options.asked};
}

Job resumed_job(const SimulateOptions& options) {
    // Read first: what is refused stays as it was, its schema included.
    const TrialStore begun = TrialStore::open(options.database);
    const Simulation stored = simulation_from_json(begun.plan_json(), options.database + ": plan");
    const Simulation simulation = agreed_simulation(options, stored);
    const Design design = design_from_json(begun.design_json(), options.database + ": design");
    if (!options.design_file.empty() && to_json(read_design(options.design_file)) != to_json(design)) {
        throw InputError(options.design_file, "isn't the design that the database was begun with", kContradiction);
    }
    TrialStore store = TrialStore::open_to_write(options.database);
    std::optional<WriterLock> lock(std::in_place, options.database, "simulation");
    return {std::move(store), std::move(lock), design, simulation};
}

/// One line for each trial, or each one taken back, with what its track's engine makes of it.
void print_line(const Trial& trial, const ThresholdEstimate& estimate) {
    nlohmann::ordered_json line{{"session", trial.session},   {"presentation", trial.presentation},
                                {"observer", trial.observer}, {"round", trial.round},
                                {"track", trial.track},       {"trial", trial.trial},
                                {"kind", name(trial.kind)}};
    if (trial.is_void) {
        line["void"] = true;
    } else {
        line["pattern"] = name(trial.condition.pattern);
        line["contrast"] = trial.condition.contrast;
        line["texel_px"] = trial.condition.texel_px;
        line["radius_px"] = trial.radius_px;
        line["stimulus"] = name(trial.stimulus);
        line["response"] = name(trial.response);
        line["correct"] = trial.correct();
    }
    line["threshold"] = estimate.threshold;
    line["sd"] = estimate.sd;
    const std::string text = line.dump() + "\n";
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        throw FailureError("standard output", "can't be written", "check where it goes; --resume goes on");
    }
}

/// The session of the n-th observer, held: begun now, or gone on with. None where it has ended.
std::optional<SessionRecord> held_session(Job& job, const std::vector<SessionRecord>& begun, int observer_index,
                                          const std::string& database) {
    SessionRecord wanted = session_record(job.simulation, observer_index);
    for (const SessionRecord& session : begun) {
        if (session.observer_index != observer_index) continue;
        if (session.observer != wanted.observer || session.seed != wanted.seed ||
            session.observer_kind != wanted.observer_kind) {
            throw InputError(database + ": session " + std::to_string(session.session),
                             "isn't one that its plan begins", "restore it from a copy");
        }
        if (session.end) return std::nullopt;
        job.store.hold_session(session.session);
        return session;
    }
    wanted.session = job.store.begin_session(wanted);
    return wanted;
}

void simulate(const SimulateOptions& options) {
    if (options.resume && is_in_memory(options.database)) {
        throw InputError("--resume", "nothing is kept in " + options.database, "name a file as --db");
    }
    const bool goes_on = options.resume && std::filesystem::exists(options.database);
    Job job = goes_on ? resumed_job(options) : begin_job(options);
    const int observers = job.simulation.observers;
    const std::vector<SessionRecord> begun = job.store.sessions();

    Progress progress("simulating observers, %", observers * 100L);
    long trials = 0;
    for (int i = 0; i < observers; ++i) {
        long shown_progress = 0;
        const auto advance_to = [&](long percent) {
            if (percent > shown_progress) progress.advance(percent - shown_progress);
            shown_progress = std::max(shown_progress, percent);
        };
        const std::optional<SessionRecord> record = held_session(job, begun, i, options.database);
        if (record) {
            const std::vector<Trial> before = job.store.trials(record->session);
            Session session = resumed_session(job.design, identity_of(*record), before, options.database);
            Trial last = before.empty() ? Trial{} : before.back();
            run_session(session, simulated_observer(job.simulation, i),
                        {[&](const Trial& trial) {
                             job.store.append(trial);
                             last = trial;
                             ++trials;
                         },
                         [&](int presentation) {
                             job.store.mark_void(record->session, presentation);
                             last.is_void = true;
                         },
                         [&] {
                             const size_t track = static_cast<size_t>(last.track) - 1;
                             if (options.json_lines) print_line(last, session.tracks()[track].estimate);
                             advance_to(static_cast<long>(100 * session.progress()));
                         }});
            job.store.end_session(record->session, SessionEnd::finished);
        }
        advance_to(100);
    }
    (options.json_lines ? std::cerr : std::cout)
        << (goes_on ? "went on: " : "") << "simulated " << observers << " observers, " << trials
        << (goes_on ? " more trials" : " trials") << ", into " << options.database << "\n";
}

}  // namespace

void add_simulate_command(CLI::App& app) {
    auto* command = app.add_subcommand("simulate", "Run the study with simulated observers.");
    const auto options = std::make_shared<SimulateOptions>();
    options->command = command;
    command->add_option("--observers", options->asked.observers, "how many")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command->add_option("--seed", options->asked.seed, "same seed, same study")->capture_default_str();
    command->add_option("--db", options->database, "the new database; :memory: keeps nothing")->required();
    command->add_option("--design", options->design_file,
                        "the study's design, JSON as `stairstep-study design` prints it");
    for (const PopulationFlag& flag : kPopulationFlags) {
        command->add_option(flag.name, flag.field(options->asked.population), flag.help)->capture_default_str();
    }
    command->add_flag(
        "--resume", options->resume,
        "go on with a database that was begun: its design, seed and observers hold, and flags must agree; "
        "more --observers are added. Begins one where there is none");
    command->add_flag("--json-lines", options->json_lines,
                      "print each trial, once it is stored, as a line of JSON with its track's estimate");
    command->callback([options] { simulate(*options); });
}

}  // namespace stairstep
