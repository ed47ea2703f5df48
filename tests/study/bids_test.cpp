#include "study/bids.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/number.h"
#include "study/pseudonyms.h"
#include "tests/support/command.h"
#include "tests/support/made_study.h"

namespace stairstep {
namespace {

using Files = std::map<std::string, std::string>;

BidsStudy bids_study() {
    const MadeStudy made = made_study();
    return {made.design.name,          made.design, made.sessions, made.trials, pseudonyms(made.sessions),
            {"A. Author", "B. Author"}};
}

std::vector<std::vector<std::string>> rows(const std::string& tsv) {
    std::vector<std::vector<std::string>> rows;
    for (const std::string& line : split(tsv, '\n')) {
        if (!line.empty()) rows.push_back(split(line, '\t'));
    }
    return rows;
}

/// The name of a table's sidecar, by inheritance for events.
std::string sidecar_of(const std::string& table) {
    if (table.ends_with("_events.tsv")) return "task-yesno_events.json";
    return table.substr(0, table.size() - 3) + "json";
}

TEST(Bids, NamesFilesAsTheSpecificationDoes) {
    const std::regex allowed(
        "dataset_description\\.json|README|participants\\.(tsv|json)|task-[a-zA-Z0-9]+_events\\.json|"
        "(sub-[a-zA-Z0-9]+)/\\2_sessions\\.(tsv|json)|"
        "(sub-[a-zA-Z0-9]+)/(ses-[a-zA-Z0-9]+)/beh/\\4_\\5_task-[a-zA-Z0-9]+_events\\.tsv");
    const Files files = bids_dataset(bids_study());
    for (const auto& [path, text] : files) EXPECT_TRUE(std::regex_match(path, allowed)) << path;
    for (const char* expected :
         {"dataset_description.json", "README", "participants.tsv", "sub-p01/sub-p01_sessions.tsv",
          "sub-p01/ses-01/beh/sub-p01_ses-01_task-yesno_events.tsv",
          "sub-p01/ses-02/beh/sub-p01_ses-02_task-yesno_events.tsv",
          "sub-07/ses-01/beh/sub-07_ses-01_task-yesno_events.tsv",
          "sub-sim01/ses-01/beh/sub-sim01_ses-01_task-yesno_events.tsv"}) {
        EXPECT_TRUE(files.contains(expected)) << expected;
    }
}

TEST(Bids, TablesAreRectangularWithRequiredColumnsFirstAndEveryColumnAndLevelDescribed) {
    const Files files = bids_dataset(bids_study());
    for (const auto& [path, text] : files) {
        if (path.ends_with(".json")) {
            EXPECT_TRUE(nlohmann::json::accept(text)) << path;
        }
        if (!path.ends_with(".tsv")) continue;
        const auto table = rows(text);
        const auto& header = table[0];
        const auto sidecar = nlohmann::json::parse(files.at(sidecar_of(path)));
        if (path.ends_with("_events.tsv")) {
            EXPECT_EQ(header[0] + "," + header[1], "onset,duration");
        } else {
            EXPECT_EQ(header[0], path == "participants.tsv" ? "participant_id" : "session_id");
        }
        EXPECT_GT(table.size(), 1u) << path;
        for (const auto& row : table) {
            ASSERT_EQ(row.size(), header.size()) << path;
            for (const std::string& field : row) EXPECT_FALSE(field.empty()) << path;
        }
        for (size_t i = 0; i < header.size(); ++i) {
            if (header[i] == "session_id") continue;  // the specification's own
            ASSERT_TRUE(sidecar.contains(header[i])) << path << " " << header[i];
            const auto& column = sidecar[header[i]];
            EXPECT_TRUE(column["Description"].is_string());
            if (!column.contains("Levels")) continue;
            for (size_t row = 1; row < table.size(); ++row) {
                EXPECT_TRUE(column["Levels"].contains(table[row][i])) << header[i] << " " << table[row][i];
            }
        }
    }
}

TEST(Bids, HoldsEveryTrialWithTimesFromTheSessionsStartAndNothingForWhatIsMissing) {
    const BidsStudy study = bids_study();
    const Files files = bids_dataset(study);
    size_t next = 0;
    for (const char* path : {"sub-p01/ses-01/beh/sub-p01_ses-01_task-yesno_events.tsv",
                             "sub-07/ses-01/beh/sub-07_ses-01_task-yesno_events.tsv",
                             "sub-p01/ses-02/beh/sub-p01_ses-02_task-yesno_events.tsv",
                             "sub-sim01/ses-01/beh/sub-sim01_ses-01_task-yesno_events.tsv"}) {
        const auto table = rows(files.at(path));
        const double start_s = study.trials[next].shown_at_s;
        for (size_t row = 1; row < table.size(); ++row, ++next) {
            std::map<std::string, std::string> field;
            for (size_t i = 0; i < table[0].size(); ++i) field[table[0][i]] = table[row][i];
            const Trial& trial = study.trials[next];
            EXPECT_NEAR(std::stod(field["onset"]), trial.shown_at_s - start_s, 1e-4);
            EXPECT_NEAR(std::stod(field["duration"]), trial.response_time_s, 1e-4);
            EXPECT_EQ(std::stod(field["radius_px"]), trial.radius_px);
            EXPECT_EQ(field["trial_type"], name(trial.kind));
            EXPECT_EQ(field["trial"], trial.kind == TrialKind::main ? std::to_string(trial.trial) : "n/a");
            EXPECT_EQ(field["void"], trial.is_void ? "1" : "0");
            EXPECT_EQ(field["correct"] == "1", field["stimulus"] == field["response"]);
        }
    }
    EXPECT_EQ(next, study.trials.size());
}

TEST(Bids, SaysTheDesignTheGeometryAndHowSessionsEndedButNoNameAndNoDate) {
    const Files files = bids_dataset(bids_study());
    const auto sidecar = nlohmann::json::parse(files.at("task-yesno_events.json"));
    EXPECT_EQ(sidecar["StudyDesign"]["texels_px"], nlohmann::json({10, 20}));
    // One degree at 600 mm spans 2·600·tan 0.5° = 10.472 mm, 41.89 pixels of 0.25 mm.
    EXPECT_NEAR(sidecar["ViewingGeometry"]["PixelsPerDegree"].get<double>(), 41.89, 0.01);
    EXPECT_EQ(sidecar["StimulusPresentation"]["ScreenDistance"], 0.6);
    const auto sessions = rows(files.at("sub-p01/sub-p01_sessions.tsv"));
    EXPECT_EQ(sessions[1][1], "finished");
    EXPECT_EQ(sessions[2][1], "open");
    EXPECT_EQ(rows(files.at("sub-07/sub-07_sessions.tsv"))[1][1], "aborted");
    for (const auto& [path, text] : files) {
        for (const char* secret : {"Anna", "Meier", "Öz", "2000-01", "9466848"}) {
            EXPECT_EQ((path + text).find(secret), std::string::npos) << path << " says " << secret;
        }
    }
}

TEST(Bids, RefusesWhatCannotBeADataset) {
    BidsStudy study = bids_study();
    const auto named = [&](const char* first, const char* second) {
        study.observer_names = {{"Anna Meier", first}, {"sub-07", second}, {"sim01", "sim01"}, {"Öz", "Öz"}};
        return study;
    };
    EXPECT_NO_THROW(bids_dataset(named("Anna", "sub-07")));
    EXPECT_THROW(bids_dataset(named("Anna Meier", "sub-07")), InputError);
    EXPECT_THROW(bids_dataset(named("../x", "sub-07")), InputError);
    EXPECT_THROW(bids_dataset(named("", "sub-07")), InputError);
    EXPECT_THROW(bids_dataset(named("A-1", "a1")), InputError);
    EXPECT_THROW(bids_dataset(named("07", "sub-07")), InputError);
    study.trials.clear();
    EXPECT_THROW(bids_dataset(named("Anna", "sub-07")), InputError);
}

/// BIDS' own validator (https://www.npmjs.com/package/bids-validator, 1.x), where there is one: the program that
/// STAIRSTEP_BIDS_VALIDATOR names, or bids-validator in PATH. The rules above hold without it.
TEST(Bids, PassesTheValidator) {
    const char* named = std::getenv("STAIRSTEP_BIDS_VALIDATOR");
    const std::string validator = named ? named : "bids-validator";
    const CommandResult version = run_command("'" + validator + "' --version");
    if (version.exit_code != 0) {
        ASSERT_EQ(named, nullptr) << "STAIRSTEP_BIDS_VALIDATOR can't be run: " << version.errors;
        GTEST_SKIP() << "no bids-validator in PATH: this run checks BIDS by the rules of the other tests here alone";
    }
    const TemporaryFolder folder;
    for (const auto& [path, text] : bids_dataset(bids_study())) {
        make_output_folder((folder.path() / path).parent_path());
        write_file(folder.path() / path, text);
    }
    const CommandResult result = run_command("'" + validator + "' --json " + folder.path().string());
    ASSERT_TRUE(nlohmann::json::accept(result.output)) << result.output << result.errors;
    const auto issues = nlohmann::json::parse(result.output)["issues"];
    std::cout << "bids-validator " << version.output << result.output.size() << " characters of report, "
              << issues["errors"].size() << " errors, " << issues["warnings"].size() << " warnings\n";
    EXPECT_TRUE(issues["errors"].empty()) << issues["errors"].dump(2);
    for (const auto& warning : issues["warnings"]) {
        // That observers came for different numbers of sessions is so.
        EXPECT_EQ(warning["key"], "MISSING_SESSION") << warning.dump(2);
    }
}

}  // namespace
}  // namespace stairstep
