#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "study/commands/commands.h"
#include "study/store.h"

namespace stairstep {
namespace {

struct StatusOptions {
    std::string database;
    bool as_json = false;
};

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
                            {"finished", session.end.has_value()}});
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

void add_status_command(CLI::App& app) {
    auto* command = app.add_subcommand("status", "Say what a database holds.");
    const auto options = std::make_shared<StatusOptions>();
    command->add_option("--db", options->database, "the study's database")->required();
    command->add_flag("--json", options->as_json, "print JSON");
    command->callback([options] { print_status(options->database, options->as_json); });
}

}  // namespace stairstep
