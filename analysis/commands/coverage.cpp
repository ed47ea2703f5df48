#include "analysis/coverage.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/commands/commands.h"
#include "stimuli/io/csv.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"
#include "study/design_json.h"

namespace stairstep {
namespace {

struct Options {
    CoverageSettings settings;
    int cells = 0;
    std::string design;
    std::string out;
    bool as_json = false;
};

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

void print_coverage(const Options& options) {
    std::vector<CoverageCell> cells = usual_cells(options.design.empty() ? Design() : read_design(options.design));
    if (options.cells > 0) cells.resize(std::min(cells.size(), static_cast<size_t>(options.cells)));
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
    command->add_option("--cells", options->cells, "only the first so many cells; 0 is all")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command->add_option("--design", options->design, "design file whose engine, task, sizes and trials to use");
    command->add_option("--p", options->settings.p_threshold, "share of right answers that defines a threshold")
        ->check(CLI::Range(0.55, 0.9))
        ->capture_default_str();
    command
        ->add_option("--bootstrap", options->settings.replicates,
                     "replicates for interval methods that need them; 0 leaves those out")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    command->add_option("--seed", options->settings.seed, "same seed, same studies")->capture_default_str();
    command->add_option("--jobs", options->settings.jobs, "threads, 0 for one a core; results don't depend on it")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command->add_option("--out", options->out, "also write the table as CSV");
    command->add_flag("--json", options->as_json, "print JSON");
    command->callback([options] { print_coverage(*options); });
}

}  // namespace stairstep
