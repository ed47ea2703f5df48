#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "stimuli/error.h"
#include "study/commands/commands.h"
#include "study/store_check.h"

namespace stairstep {
namespace {

struct CheckOptions {
    std::string database;
    bool as_json = false;
};

void print_json(const StoreReport& report) {
    std::cout << nlohmann::ordered_json{{"schema", report.schema},
                                        {"study", report.study},
                                        {"sessions", report.sessions},
                                        {"trials", report.trials},
                                        {"not_replayed", report.not_replayed},
                                        {"problems", report.problems}}
                     .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
              << "\n";
}

void print(const StoreReport& report, const std::string& database) {
    for (const std::string& problem : report.problems) std::cout << problem << "\n";
    if (!report.problems.empty()) return;
    std::cout << database << " is well: " << report.sessions << " sessions, " << report.trials << " trials";
    if (!report.not_replayed.empty()) {
        std::cout << "; " << report.not_replayed.size()
                  << " sessions of an older version can't be replayed, and were checked without that";
    }
    std::cout << "\n";
}

void check(const CheckOptions& options) {
    const StoreReport report = check_store(options.database);
    options.as_json ? print_json(report) : print(report, options.database);
    if (report.problems.empty()) return;
    throw FailureError(options.database, "has problems, " + std::to_string(report.problems.size()) + " in all",
                       "restore it from a copy, or leave out the sessions named");
}

}  // namespace

void add_check_command(CLI::App& app) {
    auto* command = app.add_subcommand("check", "Verify a database: whole, and each trial what its design shows.");
    const auto options = std::make_shared<CheckOptions>();
    command->add_option("--db", options->database, "the study's database")->required();
    command->add_flag("--json", options->as_json, "print JSON");
    command->callback([options] { check(*options); });
}

}  // namespace stairstep
