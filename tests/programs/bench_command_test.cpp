// stairstep-study bench in its quick form: every table whole, figures that can't be otherwise, and what it refuses. No times of
// this machine: only which engine is the faster.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "stimuli/io/csv.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class BenchCommand : public testing::Test {
  protected:
    CommandResult bench(const std::string& flags) const {
        return run_command("cd " + folder_.path().string() + " && " + program("stairstep-study") + " bench " + flags);
    }
    json figures(const std::string& flags) const {
        const CommandResult result = bench(flags + " --json");
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        EXPECT_EQ(result.errors, "");
        return json::parse(result.output);
    }
    std::string text_of(const std::string& name) const { return read_file(folder_.path() / name); }

    TemporaryFolder folder_;
};

const json& row_of(const json& table, const char* column, const std::string& value) {
    for (const json& row : table.at("rows")) {
        if (row.at(column) == value) return row;
    }
    throw std::runtime_error("no row " + value);
}

TEST_F(BenchCommand, QuickFormHasAllTablesWithSaneFigures) {
    const json all = figures("--quick --runs 100 --folder . --out figures.md");
    ASSERT_EQ(all.size(), 5u);

    const json& time = all.at("time");
    const auto us = [&](const std::string& engine) { return row_of(time, "engine", engine).at("us_per_trial"); };
    EXPECT_GT(us("Quest, 501 points"), 0);
    EXPECT_LT(us("Quest, 501 points"), us("minimum entropy, 501 points"));
    EXPECT_LT(us("Quest, 501 points"), us("psi-marginal, 251 thresholds x 52 shapes"));
    EXPECT_LT(us("Quest, 501 points"), us("LawDirected, 4 tracks, 501 points x 6 shapes"));
    const json& psychtoolbox = row_of(time, "engine", "Psychtoolbox under Octave, 501 points");
    if (psychtoolbox.at("us_per_trial").is_null()) {
        EXPECT_NE(time.at("notes").dump().find("No ratios: "), std::string::npos);
    } else {
        EXPECT_GT(psychtoolbox.at("us_per_trial"), us("Quest, 501 points"));
    }

    const json& accuracy = all.at("accuracy").at("rows");
    ASSERT_EQ(accuracy.size(), 30u);
    for (size_t i = 0; i < accuracy.size(); ++i) {
        const json& row = accuracy[i];
        SCOPED_TRACE(row.dump());
        EXPECT_EQ(row.at("trials"), 20 * (i % 3 + 1));
        EXPECT_GT(row.at("rmse").get<double>() + 2 * row.at("rmse_se").get<double>(), row.at("bound").get<double>());
        EXPECT_LT(std::abs(row.at("bias").get<double>()), row.at("rmse").get<double>());
        EXPECT_GT(row.at("robust_sd").get<double>(), 0);
    }

    // An observer much shallower than Quest takes for granted: its intervals are too short, psi-marginal's aren't.
    double quest_covers = 0, psi_covers = 0;
    ASSERT_EQ(all.at("coverage").at("rows").size(), 60u);
    for (const json& row : all.at("coverage").at("rows")) {
        EXPECT_GE(row.at("coverage"), 0);
        EXPECT_LE(row.at("coverage"), 1);
        if (row.at("beta") != 1.3) continue;
        if (row.at("method") == "Quest") quest_covers += row.at("coverage").get<double>() / 4;
        if (row.at("method") == "psi-marginal") psi_covers += row.at("coverage").get<double>() / 4;
    }
    EXPECT_LT(quest_covers, 0.75);
    EXPECT_GT(psi_covers, quest_covers + 0.1);

    EXPECT_EQ(all.at("gain").at("rows").size(), 10u);
    const json& study = all.at("study").at("rows");
    ASSERT_EQ(study.size(), 3u);
    for (const json& row : study) {
        EXPECT_EQ(row.at("trials"), 640);
        EXPECT_GT(row.at("trials_per_s"), 0);
    }

    // The file has the same rows, and nothing else is left in the folder.
    const std::string markdown = text_of("figures.md");
    EXPECT_NE(markdown.find("stairstep-study bench --quick --runs 100 --observers 1 --seed 1 --out figures.md"),
              std::string::npos)
        << markdown;
    for (const json& table : all) {
        EXPECT_NE(markdown.find("## " + table.at("title").get<std::string>()), std::string::npos);
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(BenchCommand, IsTheSameForASeedOnAnyNumberOfThreads) {
    const std::string flags = "accuracy gain --quick --runs 40 --seed ";
    const json one = figures(flags + "5 --jobs 1");
    EXPECT_EQ(one.size(), 2u);
    EXPECT_EQ(one, figures(flags + "5 --jobs 3"));
    EXPECT_NE(one, figures(flags + "6 --jobs 3"));
}

TEST_F(BenchCommand, SaysSoWherePsychtoolboxIsMissing) {
    const CommandResult result = bench("time --quick --psychtoolbox /nowhere --out time.csv");
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_NE(result.output.find("No ratios: Psychtoolbox isn't in /nowhere."), std::string::npos) << result.output;
    EXPECT_NE(result.output.find(">= 500   unknown"), std::string::npos) << result.output;
    const CsvTable csv = CsvTable::read(folder_.path() / "time.csv");
    EXPECT_GT(csv.row_count(), 10u);
    EXPECT_EQ(csv.text(0, csv.column("table")), "time");
}

TEST_F(BenchCommand, RefusesWhatItCannotDo) {
    const std::pair<const char*, int> bad[] = {
        {"speed --quick", 2},
        {"--quick --runs 39", 2},
        {"--quick --observers 0", 2},
        {"--quick --jobs=-1", 2},
        {"accuracy --quick --out figures.txt", 2},
        {"accuracy --quick --out nowhere/figures.md", 1},
        {"study --quick --folder nowhere", 1},
    };
    for (const auto& [flags, exit_code] : bad) {
        const CommandResult result = bench(flags);
        EXPECT_EQ(result.exit_code, exit_code) << flags;
        EXPECT_TRUE(is_one_error_line(result.errors)) << flags << "\n" << result.errors;
        EXPECT_EQ(result.output, "");
    }
    EXPECT_TRUE(fs::is_empty(folder_.path()));
}

}  // namespace
}  // namespace stairstep
