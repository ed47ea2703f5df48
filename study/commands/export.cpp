#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "stimuli/error.h"
#include "stimuli/io/json_file.h"
#include "stimuli/io/output_file.h"
#include "study/bids.h"
#include "study/commands/commands.h"
#include "study/design_json.h"
#include "study/pseudonyms.h"
#include "study/store.h"
#include "study/trials_csv.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
    std::string database;
    std::string folder;
    std::string format = "csv";
    bool names = false;
    std::vector<std::string> authors;
};

/// What the export calls each observer.
std::map<std::string, std::string> observer_names(const std::vector<SessionRecord>& sessions, bool names) {
    if (!names) return pseudonyms(sessions);
    std::map<std::string, std::string> same;
    for (const SessionRecord& session : sessions) same[session.observer] = session.observer;
    return same;
}

void export_csv(const TrialStore& store, const ExportOptions& options) {
    std::vector<Trial> trials = store.trials();
    const auto names = observer_names(store.sessions(), options.names);
    for (Trial& trial : trials) trial.observer = names.at(trial.observer);
    make_output_folder(options.folder, Access::owner_only);
    const fs::path file = fs::path(options.folder) / "trials.csv";
    write_file(file, trials_csv(trials), Access::owner_only);
    std::cout << "wrote " << trials.size() << " trials to " << file.string() << "\n";
}

/// A dataset may be written again over an earlier export of its study, but not into another one, nor beside subjects of an
/// export that called them otherwise: their folders would stay, names and all.
void require_own_dataset(const fs::path& folder, const std::string& study,
                         const std::map<std::string, std::string>& files) {
    const fs::path description = folder / "dataset_description.json";
    std::error_code error;
    if (fs::exists(description, error)) {
        const auto json = nlohmann::json::parse(read_file(description), nullptr, false);
        const std::string name = json.is_object() && json.contains("Name") && json["Name"].is_string()
                                     ? json["Name"].get<std::string>()
                                     : "";
        if (name != study) {
            throw InputError(description.string(), "belongs to another dataset" + (name.empty() ? "" : ", " + name),
                             "choose another --out");
        }
    }
    std::set<std::string> subjects;
    for (const auto& [path, text] : files) {
        if (path.starts_with("sub-")) subjects.insert(path.substr(0, path.find('/')));
    }
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("sub-") && !subjects.contains(name)) {
            throw InputError(entry.path().string(), "is a subject that this export doesn't have",
                             "choose another --out");
        }
    }
}

void export_bids(const TrialStore& store, const ExportOptions& options) {
    BidsStudy study{store.study(),
                    design_from_json(store.design_json(), options.database + ": design"),
                    store.sessions(),
                    store.trials(),
                    {},
                    options.authors};
    study.observer_names = observer_names(study.sessions, options.names);
    const std::map<std::string, std::string> files = bids_dataset(study);
    const fs::path folder = options.folder;
    require_own_dataset(folder, study.name, files);
    make_output_folder(folder, Access::owner_only);
    size_t subjects = 0;
    for (const auto& [path, text] : files) {
        make_output_folder((folder / path).parent_path(), Access::owner_only);
        write_file(folder / path, text, Access::owner_only);
        if (path.ends_with("_sessions.tsv")) ++subjects;
    }
    std::cout << "wrote " << study.trials.size() << " trials of " << subjects << " subjects to the BIDS dataset "
              << folder.string() << "\n";
}

}  // namespace

void add_export_command(CLI::App& app) {
    auto* command = app.add_subcommand("export",
                                       "Write the trials as trials.csv or as a BIDS dataset, readable by you alone; "
                                       "observers get pseudonyms.");
    const auto options = std::make_shared<ExportOptions>();
    command->add_option("--db", options->database, "the study's database")->required();
    command->add_option("--out", options->folder, "folder for trials.csv or the dataset")->required();
    command->add_option("--format", options->format, "csv or bids")
        ->check(CLI::IsMember({"csv", "bids"}))
        ->capture_default_str();
    command->add_flag("--names", options->names, "keep observers' IDs as they were typed, names of people included");
    command->add_option("--author", options->authors, "an author of the BIDS dataset; may be given several times")
        ->expected(1)
        ->take_all();
    command->callback([options] {
        const TrialStore store = TrialStore::open(options->database);
        options->format == "csv" ? export_csv(store, *options) : export_bids(store, *options);
    });
}

}  // namespace stairstep
