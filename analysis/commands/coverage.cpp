#include "analysis/coverage.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/commands/commands.h"
#include "analysis/coverage_table.h"
#include "stimuli/error.h"
#include "stimuli/io/csv.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"
#include "study/design_json.h"

namespace stairstep {
namespace {

struct Options {
    CoverageSettings settings;
    /// "usual", "all", "third", or a number of usual cells.
    std::string cells = "usual";
    int bootstrap_studies = 300;
    std::string design;
    std::string out;
    std::string markdown;
    bool resume = false;
    bool as_json = false;
    CLI::App* command = nullptr;

    bool is_factorial() const { return cells == "all" || cells == "third"; }
};

/// Replicates of the factorial's bootstraps unless told otherwise: they take a third of its time.
constexpr int kFactorialReplicates = 500;

std::string padded(std::string text, size_t width) {
    text.resize(std::max(width, text.size()), ' ');
    return text;
}

std::string table(const std::vector<CellCoverage>& cells) {
    std::string text = padded("cell", 28) + padded("method", 16) +
                       "coverage          bias of ln c       SD     width of ln c  studies\n";
    for (const CellCoverage& cell : cells) {
        for (const MethodCoverage& m : cell.methods) {
            text += padded(&m == &cell.methods[0] ? cell.cell : "", 28) + padded(m.method, 16) +
                    padded(format_fixed(m.coverage, 3) + " +- " + format_fixed(m.coverage_se, 3) +
                               (m.is_on_target() ? "" : " !"),
                           18) +
                    padded(format_fixed(m.bias, 4) + " +- " + format_fixed(m.bias_se, 4), 19) +
                    padded(format_fixed(m.sd, 3), 7) + padded(format_fixed(m.width, 3), 15) +
                    std::to_string(m.studies) + "\n";
        }
        if (cell.failed > 0) text += padded("", 28) + std::to_string(cell.failed) + " studies could not be fitted\n";
    }
    return text + "! outside .93 to .97 by more than two standard errors\n";
}

std::string csv(const std::vector<CellCoverage>& cells) {
    CsvWriter csv;
    csv.row({"cell", "method", "studies", "coverage", "coverage_se", "bias_ln", "bias_se", "sd_ln", "width_ln",
             "on_target", "failed"});
    for (const CellCoverage& cell : cells) {
        for (const MethodCoverage& m : cell.methods) {
            csv.row({cell.cell, m.method, std::to_string(m.studies), format_number(m.coverage),
                     format_number(m.coverage_se), format_number(m.bias), format_number(m.bias_se), format_number(m.sd),
                     format_number(m.width), m.is_on_target() ? "1" : "0", std::to_string(cell.failed)});
        }
    }
    return csv.text();
}

nlohmann::ordered_json json(const std::vector<CellCoverage>& cells) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const CellCoverage& cell : cells) {
        for (const MethodCoverage& m : cell.methods) {
            rows.push_back({{"cell", cell.cell},
                            {"method", m.method},
                            {"studies", m.studies},
                            {"coverage", m.coverage},
                            {"coverage_se", m.coverage_se},
                            {"bias_ln", m.bias},
                            {"bias_se", m.bias_se},
                            {"sd_ln", m.sd},
                            {"width_ln", m.width},
                            {"on_target", m.is_on_target()},
                            {"failed", cell.failed}});
        }
    }
    return rows;
}

Design design_of(const Options& options) {
    return options.design.empty() ? Design() : read_design(options.design);
}

/// The usual cells that were asked for.
size_t cell_count(const std::string& text, size_t all) {
    if (text == "usual" || text == "0") return all;
    const std::vector<double> numbers = parse_number_list(text, "--cells");
    if (numbers.size() != 1 || !(numbers[0] >= 1) || numbers[0] != std::floor(numbers[0])) {
        throw InputError("--cells", text + " is no choice of cells", "use usual, third, all or a number");
    }
    return static_cast<size_t>(std::min(numbers[0], static_cast<double>(all)));
}

/// What makes the document again; not how many threads it took.
std::string factorial_command(const Options& options, const FactorialSettings& settings) {
    return "stairstep-analyze coverage --cells " + options.cells + " --studies " + std::to_string(settings.studies) +
           " --bootstrap " + std::to_string(settings.replicates) + " --bootstrap-studies " +
           std::to_string(settings.bootstrap_studies) + (options.design.empty() ? "" : " --design " + options.design) +
           " --p " + format_number(settings.p_threshold) + " --seed " + std::to_string(settings.seed) +
           " --out docs/coverage.csv --markdown docs/coverage.md";
}

void print_factorial(const Options& options) {
    const CoverageSettings& common = options.settings;
    const FactorialSettings settings{
        common.studies,
        options.bootstrap_studies,
        options.command->count("--bootstrap") > 0 ? common.replicates : kFactorialReplicates,
        common.seed,
        common.jobs,
        common.p_threshold};
    const Design design = design_of(options);
    CoverageTable table;
    if (options.resume && std::filesystem::exists(options.out)) {
        table = CoverageTable::read(CsvTable::read(options.out), settings);
    }
    std::vector<FactorialPopulation> missing;
    for (const FactorialPopulation& population :
         factorial_populations(options.cells == "all" ? FactorialShare::all : FactorialShare::third)) {
        if (!table.holds(population)) missing.push_back(population);
    }
    {
        Progress progress("simulating studies", static_cast<long>(missing.size()) * settings.studies);
        for (const FactorialPopulation& population : missing) {
            table.add(factorial_coverage(population, design, settings, [&] { progress.advance(); }), settings);
            // After each population, so that a run that is interrupted can go on.
            if (!options.out.empty()) write_file(options.out, table.csv());
        }
    }
    const std::string text =
        coverage_document(CsvTable::parse(table.csv(), options.out.empty() ? "coverage" : options.out),
                          factorial_command(options, settings));
    if (!options.markdown.empty()) write_file(options.markdown, text);
    std::cout << (options.as_json ? table.csv() : text);
}

void print_coverage(const Options& options) {
    if (options.is_factorial()) return print_factorial(options);
    if (options.resume || !options.markdown.empty()) {
        throw InputError(options.resume ? "--resume" : "--markdown", "goes with the factorial alone",
                         "use --cells third or all");
    }
    std::vector<CoverageCell> cells = usual_cells(design_of(options));
    cells.resize(cell_count(options.cells, cells.size()));
    Progress progress("simulating studies", static_cast<long>(cells.size()) * options.settings.studies);
    std::vector<CellCoverage> results;
    for (const CoverageCell& cell : cells) {
        results.push_back(coverage_of(cell, options.settings, [&] { progress.advance(); }));
    }
    if (!options.out.empty()) write_file(options.out, csv(results));
    std::cout << (options.as_json ? json(results).dump(2) + "\n" : table(results));
}

}  // namespace

void add_coverage_command(CLI::App& app) {
    auto* command = app.add_subcommand(
        "coverage", "Simulate studies with a planted law and count how often each interval for its slope holds it.");
    const auto options = std::make_shared<Options>();
    command->add_option("--studies", options->settings.studies, "studies a cell")
        ->check(CLI::Range(2, 1000000))
        ->capture_default_str();
    command
        ->add_option("--cells", options->cells,
                     "usual: cells that change one thing about a usual study, a number for the first so many; all: a "
                     "factorial of 108; third: a balanced third of that")
        ->capture_default_str();
    command->add_option("--design", options->design, "design file whose engine, task, sizes and trials to use");
    command->add_option("--p", options->settings.p_threshold, "share of right answers that defines a threshold")
        ->check(CLI::Range(0.55, 0.9))
        ->capture_default_str();
    command
        ->add_option(
            "--bootstrap", options->settings.replicates,
            "replicates for interval methods that need them; 0 leaves those out; the factorial has 500 unless told")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    command
        ->add_option("--bootstrap-studies", options->bootstrap_studies,
                     "of how many of the factorial's studies bootstraps are made")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    command->add_option("--seed", options->settings.seed, "same seed, same studies")->capture_default_str();
    command->add_option("--jobs", options->settings.jobs, "threads, 0 for one a core; results don't depend on it")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    auto* out = command->add_option("--out", options->out, "also write the table as CSV");
    command->add_option("--markdown", options->markdown, "also write the factorial's tables as a document");
    command->add_flag("--resume", options->resume, "keep what --out has of the factorial, and measure what is missing")
        ->needs(out);
    options->command = command;
    command->add_flag("--json", options->as_json, "print JSON");
    command->callback([options] { print_coverage(*options); });
}

}  // namespace stairstep
