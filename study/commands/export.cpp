#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "stimuli/io/output_file.h"
#include "study/commands/commands.h"
#include "study/store.h"
#include "study/trials_csv.h"

namespace stairstep {
namespace {

struct ExportOptions {
    std::string database;
    std::string folder;
};

void export_trials(const std::string& database, const std::string& folder) {
    const std::vector<Trial> trials = TrialStore::open(database).trials();
    make_output_folder(folder);
    const std::filesystem::path file = std::filesystem::path(folder) / "trials.csv";
    write_file(file, trials_csv(trials));
    std::cout << "wrote " << trials.size() << " trials to " << file.string() << "\n";
}

}  // namespace

void add_export_command(CLI::App& app) {
    auto* command = app.add_subcommand("export", "Write the trials as trials.csv.");
    const auto options = std::make_shared<ExportOptions>();
    command->add_option("--db", options->database, "the study's database")->required();
    command->add_option("--out", options->folder, "folder for trials.csv")->required();
    command->add_option("--format")->check(CLI::IsMember({"csv"}))->default_str("csv");
    command->callback([options] { export_trials(options->database, options->folder); });
}

}  // namespace stairstep
