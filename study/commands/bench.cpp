#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "study/bench/accuracy.h"
#include "study/bench/gain_table.h"
#include "study/bench/study_rate.h"
#include "study/bench/timing.h"
#include "study/commands/commands.h"

namespace stairstep {
namespace {

const std::vector<std::string> kParts{"time", "accuracy", "coverage", "gain", "study"};

struct BenchOptions {
    std::vector<std::string> parts;
    int runs = 40000;
    int observers = 100;
    uint64_t seed = 1;
    int jobs = 0;
    bool quick = false;
    bool as_json = false;
    std::string out;
    std::string folder;
    std::string psychtoolbox = kPsychtoolboxFolder;
    CLI::App* command = nullptr;

    bool given(const char* flag) const { return command->count(flag) > 0; }
    bool wants(const std::string& part) const {
        return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
    }
};

GainSettings gain_settings(const BenchOptions& options) {
    GainSettings settings;
    settings.runs = std::max(20, options.runs / 200);
    settings.seed = options.seed;
    settings.jobs = options.jobs;
    if (options.quick) {
        settings.engine.grain = 0.05;
        settings.checkpoints = {20, 40};
    }
    return settings;
}

std::vector<BenchTable> measure(const BenchOptions& options) {
    const AccuracySettings accuracy{options.runs, options.seed, options.jobs};
    std::vector<BenchTable> tables;
    if (options.wants("time")) {
        tables.push_back(measure_times(
            {.tracks = options.quick ? 30 : 300, .seed = options.seed, .psychtoolbox = options.psychtoolbox}));
    }
    if (options.wants("accuracy")) tables.push_back(measure_accuracy(accuracy));
    if (options.wants("coverage")) tables.push_back(measure_coverage(accuracy));
    if (options.wants("gain")) tables.push_back(measure_gain(gain_settings(options)));
    if (options.wants("study")) {
        tables.push_back(measure_study_rate({options.observers, options.seed, options.folder}));
    }
    return tables;
}

/// The command that makes the same figures again, where they don't depend on the machine.
std::string command_line(const BenchOptions& options) {
    std::string line = "stairstep-study bench";
    for (const std::string& part : options.parts) line += " " + part;
    if (options.quick) line += " --quick";
    line += " --runs " + std::to_string(options.runs) + " --observers " + std::to_string(options.observers) +
            " --seed " + std::to_string(options.seed);
    return line;
}

std::string markdown(const BenchOptions& options, const std::vector<BenchTable>& tables) {
    const std::filesystem::path out = options.out;
    std::string text =
        "# What the engines do: figures\n\nMade by\n\n```\n" + command_line(options) + " --out " +
        (out.is_relative() ? out : out.filename()).string() +
        "\n```\n\nwith version " STAIRSTEP_VERSION " on a machine of " +
        std::to_string(std::thread::hardware_concurrency()) +
        " cores. Errors and coverage are the same again for the same seed, on any\nmachine and with any "
        "number of `--jobs`. Times are one machine's, which others used meanwhile: their ratios count.\n";
    for (const BenchTable& table : tables) text += "\n" + to_markdown(table);
    return text;
}

void bench(BenchOptions options) {
    if (options.quick) {
        if (!options.given("--runs")) options.runs = 800;
        if (!options.given("--observers")) options.observers = 1;
    }
    const std::string extension = std::filesystem::path(options.out).extension().string();
    if (!options.out.empty() && extension != ".md" && extension != ".csv") {
        throw InputError("--out " + options.out, "ends in neither .md nor .csv", "name a file that does");
    }
    // Minutes of work shouldn't end at a folder that isn't there.
    if (!options.out.empty()) const OutputFile probe(options.out);

    const std::vector<BenchTable> tables = measure(options);
    if (!options.out.empty()) write_file(options.out, extension == ".md" ? markdown(options, tables) : to_csv(tables));
    if (options.as_json) {
        std::cout << to_json(tables).dump(2) << "\n";
        return;
    }
    for (const BenchTable& table : tables) std::cout << (&table == tables.data() ? "" : "\n") << to_text(table);
}

}  // namespace

void add_bench_command(CLI::App& app) {
    auto* command = app.add_subcommand(
        "bench",
        "Measure the engines: time per trial beside Psychtoolbox's, accuracy beside the Fisher bound, what 95 %\n"
        "intervals cover, what law-directed placement gains, and how fast a simulated study runs. Takes some\n"
        "minutes; errors and coverage depend on the seed alone.");
    const auto options = std::make_shared<BenchOptions>();
    options->command = command;
    command->add_option("parts", options->parts, "time, accuracy, coverage, gain, study; without any, all")
        ->check(CLI::IsMember(kParts));
    command
        ->add_option("--runs", options->runs,
                     "simulated tracks a method for accuracy; psi-marginal does a fifth of them, coverage takes a "
                     "twentieth an observer, gain a 200th, 20 at least")
        ->check(CLI::Range(40, 10'000'000))
        ->capture_default_str();
    command->add_option("--observers", options->observers, "of the simulated study, 640 trials each")
        ->check(CLI::Range(1, 100'000))
        ->capture_default_str();
    command->add_option("--seed", options->seed, "same seed, same errors and coverage")->capture_default_str();
    command->add_option("--jobs", options->jobs, "threads for accuracy, coverage and gain; 0: one a core")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command->add_flag("--quick", options->quick, "a rough look in some 10 s: few runs, one observer");
    command->add_option("--folder", options->folder,
                        "where the study's database is made, and removed again; without it, where temporary files go");
    command->add_option("--psychtoolbox", options->psychtoolbox, "where Psychtoolbox is, to be timed under Octave")
        ->capture_default_str();
    command->add_option("--out", options->out, "also write the tables: FILE.md or FILE.csv");
    command->add_flag("--json", options->as_json, "print JSON");
    command->callback([options] { bench(*options); });
}

}  // namespace stairstep
