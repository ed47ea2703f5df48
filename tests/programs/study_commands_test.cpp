// export and status as a lab runs them, on a study that has everything.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "stimuli/io/csv.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "tests/support/command.h"
#include "tests/support/made_study.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

class StudyCommands : public testing::Test {
  protected:
    StudyCommands() : study_(made_study()) { write_study(file("s.sqlite"), study_); }

    fs::path file(const std::string& name) const { return folder_.path() / name; }

    CommandResult try_to(const std::string& command) const {
        return run_command("cd " + folder_.path().string() + " && umask 000 && " + program("stairstep-study") + " " +
                           command);
    }
    CommandResult run(const std::string& command) const {
        const CommandResult result = try_to(command);
        EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.errors;
        return result;
    }
    /// Runs a command that must fail with one line.
    void expect_refused(const std::string& command, int exit_code) const {
        const CommandResult result = try_to(command);
        EXPECT_EQ(result.exit_code, exit_code) << command;
        EXPECT_TRUE(is_one_error_line(result.errors)) << command << "\n" << result.errors;
    }

    TemporaryFolder folder_;
    MadeStudy study_;
};

TEST_F(StudyCommands, ExportsEveryTrialUnderPseudonyms) {
    run("export --db s.sqlite --out out");
    const CsvTable table = CsvTable::read(file("out/trials.csv"));
    ASSERT_EQ(table.row_count(), study_.trials.size());
    for (size_t row = 0; row < table.row_count(); ++row) {
        const Trial& trial = study_.trials[row];
        EXPECT_EQ(table.text(row, table.column("observer")), trial.observer == "Anna Meier" ? "p01" : trial.observer);
        EXPECT_EQ(table.text(row, table.column("void")), trial.is_void ? "1" : "0");
        EXPECT_EQ(table.text(row, table.column("kind")), name(trial.kind));
    }
    EXPECT_EQ(read_file(file("out/trials.csv")).find("Anna"), std::string::npos);
    run("export --db s.sqlite --out named --names");
    const CsvTable named = CsvTable::read(file("named/trials.csv"));
    EXPECT_EQ(named.text(0, named.column("observer")), "Anna Meier");
}

TEST_F(StudyCommands, ExportsAreTheirOwnersAlone) {
    fs::create_directory(file("shared"));
    fs::permissions(file("shared"), fs::perms(0755));
    write_file(file("shared/trials.csv"), "old");
    fs::permissions(file("shared/trials.csv"), fs::perms(0644));
    write_file(file("shared/notes.txt"), "kept");
    run("export --db s.sqlite --out shared");
    EXPECT_EQ(fs::status(file("shared/trials.csv")).permissions(), fs::perms(0600));
    EXPECT_EQ(fs::status(file("shared")).permissions(), fs::perms(0755));
    EXPECT_EQ(read_file(file("shared/notes.txt")), "kept");

    run("export --db s.sqlite --out new/bids/ --format bids");
    EXPECT_EQ(fs::status(file("new")).permissions(), fs::perms(0700));
    for (const auto& entry : fs::recursive_directory_iterator(file("new"))) {
        EXPECT_EQ(entry.status().permissions(), fs::perms(entry.is_directory() ? 0700 : 0600)) << entry.path();
    }
}

TEST_F(StudyCommands, ABidsExportGoesOverItselfAndOverNothingElse) {
    run("export --db s.sqlite --out b --format bids --author 'A. Author' --author 'B. Author'");
    const auto description = nlohmann::json::parse(read_file(file("b/dataset_description.json")));
    EXPECT_EQ(description["Name"], "pilot 1");
    EXPECT_EQ(description["Authors"], nlohmann::json({"A. Author", "B. Author"}));
    run("export --db s.sqlite --out b --format bids");

    MadeStudy other = study_;
    other.design.name = "another";
    write_study(file("other.sqlite"), other);
    expect_refused("export --db other.sqlite --out b --format bids", 2);
    fs::create_directory(file("b/sub-Anna"));
    expect_refused("export --db s.sqlite --out b --format bids", 2);
    expect_refused("export --db s.sqlite --out c --format bids --names", 2);  // "Anna Meier" is no label
    EXPECT_FALSE(fs::exists(file("c")));
}

TEST_F(StudyCommands, ExportSaysWhatItCannot) {
    expect_refused("export --db s.sqlite --out out --format xml", 2);
    expect_refused("export --db absent.sqlite --out out", 2);
    expect_refused("export --db s.sqlite --out s.sqlite", 1);
    expect_refused("export --db s.sqlite --out /proc/self/out --format bids", 1);
    EXPECT_FALSE(fs::exists(file("out")));
}

TEST_F(StudyCommands, AStudyWithoutTrialsIsAnEmptyTableAndNoDataset) {
    MadeStudy empty = study_;
    empty.trials.clear();
    write_study(file("empty.sqlite"), empty);
    run("export --db empty.sqlite --out out");
    const std::string table = read_file(file("out/trials.csv"));
    EXPECT_TRUE(table.starts_with("study,observer,session,"));
    EXPECT_EQ(table.find('\n'), table.size() - 1);
    expect_refused("export --db empty.sqlite --out b --format bids", 2);
    EXPECT_FALSE(fs::exists(file("b")));
    EXPECT_EQ(nlohmann::json::parse(run("status --db empty.sqlite --json").output)["trials"], 0);
    run("status --db empty.sqlite");
}

TEST_F(StudyCommands, StatusHasEachSessionAndTrack) {
    const auto status = nlohmann::json::parse(run("status --db s.sqlite --json").output);
    EXPECT_EQ(status["study"], "pilot 1");
    EXPECT_EQ(status["trials"], study_.trials.size());
    ASSERT_EQ(status["sessions"].size(), 5u);
    const auto& first = status["sessions"][0];
    EXPECT_EQ(first["session"], 1);
    EXPECT_EQ(first["observer"], "Anna Meier");
    EXPECT_EQ(first["pseudonym"], "p01");
    EXPECT_EQ(first["kind"], "person");
    EXPECT_EQ(first["finished"], true);
    EXPECT_EQ(first["main_trials"], 24);
    EXPECT_EQ(first["track_states"].size(), 4u);
    EXPECT_EQ(status["sessions"][1]["state"], "aborted");
    EXPECT_EQ(status["sessions"][2]["state"], "open");
    EXPECT_GT(status["sessions"][2]["time_left_s"].get<double>(), 1);
    EXPECT_TRUE(first["time_left_s"].is_null());
}

TEST_F(StudyCommands, StatusIsATableWithEveryColumnInLine) {
    const std::string text = run("status --db s.sqlite").output;
    EXPECT_NE(text.find("Anna Meier  p01"), std::string::npos) << text;
    EXPECT_NE(text.find("24/24"), std::string::npos) << text;
    EXPECT_NE(text.find("session 3, open:"), std::string::npos) << text;
    EXPECT_NE(text.find("step, contrast 1, texel 10 px"), std::string::npos) << text;
}

}  // namespace
}  // namespace stairstep
