// stairstep-study quest, from its standard input to its JSON, against Psychtoolbox's numbers; and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/number.h"
#include "tests/support/command.h"
#include "tests/support/psychtoolbox_reference.h"

namespace stairstep {
namespace {

class QuestCommand : public testing::Test {
  protected:
    /// Runs the command with a text on standard input.
    CommandResult quest(const std::string& flags, const std::string& input) {
        const std::filesystem::path file = folder_.path() / "trials.csv";
        write_file(file, input);
        return run_command(program("stairstep-study") + " quest " + flags + " < " + file.string());
    }

    TemporaryFolder folder_;
};

std::string flags_of(const PsychtoolboxQuestSettings& s) {
    std::string flags = "--json --guess=" + format_number(s.guess) + " --guess-sd " + format_number(s.guess_sd) +
                        " --p-threshold " + format_number(s.shape.p_threshold) + " --beta " +
                        format_number(s.shape.beta) + " --delta " + format_number(s.shape.delta) + " --gamma " +
                        format_number(s.shape.gamma) + " --grain " + format_number(s.grain);
    if (s.range) flags += " --range " + format_number(*s.range);
    return flags;
}

TEST_F(QuestCommand, PrintsPsychtoolboxsNumbers) {
    for (const PsychtoolboxReference& r : psychtoolbox_references()) {
        if (r.settings.shape.gamma > r.settings.shape.p_threshold) continue;  // the command refuses these
        SCOPED_TRACE(flags_of(r.settings));
        std::string input = "trial,intensity,note,response\n";
        for (size_t i = 0; i < r.trials.size(); ++i) {
            input += std::to_string(i) + "," + format_number(r.trials[i].intensity) + ",\"a, b\"," +
                     (r.trials[i].correct ? "1" : "0") + "\n";
        }
        const CommandResult result = quest(flags_of(r.settings), input);
        ASSERT_EQ(result.exit_code, 0) << result.errors;
        const auto json = nlohmann::json::parse(result.output);
        EXPECT_EQ(json.size(), 5u);
        EXPECT_NEAR(json.at("mean").get<double>(), r.mean, 1e-9);
        EXPECT_NEAR(json.at("mode").get<double>(), r.mode, 1e-9);
        EXPECT_NEAR(json.at("quantile").get<double>(), r.quantile, 1e-9);
        EXPECT_NEAR(json.at("sd").get<double>(), r.sd, 1e-9);
        EXPECT_EQ(json.at("trials"), r.trials.size());
        const auto low = nlohmann::json::parse(quest(flags_of(r.settings) + " --quantile-order 0.025", input).output);
        EXPECT_NEAR(low.at("quantile").get<double>(), r.low, 1e-9);
    }
}

TEST_F(QuestCommand, OurOwnEngineTellsFarIntensitiesApart) {
    // A hit at +1.9 rules out higher thresholds, one at +5 none; Psychtoolbox's range ends at +1 and makes them one.
    const auto mean = [&](const std::string& engine, const char* intensity) {
        const CommandResult result = quest("--guess 0 --range 2 --json --engine " + engine,
                                           std::string("intensity,response\n") + intensity + ",1\n");
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        EXPECT_EQ(result.errors.starts_with("warning: "), engine == "psychtoolbox") << result.errors;
        return nlohmann::json::parse(result.output).at("mean").get<double>();
    };
    EXPECT_EQ(mean("psychtoolbox", "1.2"), mean("psychtoolbox", "5"));
    EXPECT_LT(mean("stairstep", "1.2"), mean("stairstep", "5"));
}

TEST_F(QuestCommand, RefusesBadTrials) {
    const std::pair<const char*, const char*> bad[] = {
        {"", "standard input: is empty"},
        {"intensity,response\n", "standard input: has no trials"},
        {"-1,1\n-2,0\n", "no column \"intensity\""},
        {"intensity,answer\n1,1\n", "no column \"response\""},
        {"intensity,response\n-1,1\nnan,1\n", "line 3, column intensity: \"nan\""},
        {"intensity,response\n-1,1\n\ninf,1\n", "line 4, column intensity: \"inf\""},
        {"intensity,response\n1e999,1\n", "line 2, column intensity"},
        {"intensity,response\n,1\n", "line 2, column intensity"},
        {"intensity,response\n-1,1\n-1,2\n", "line 3, column response: \"2\" is neither 0 nor 1"},
        {"intensity,response\n-1,0.5\n", "line 2, column response"},
        {"intensity,response\n-1,nan\n", "line 2, column response"},
        {"intensity,response\n-1,yes\n", "line 2, column response"},
        {"intensity,response\n-1\n", "line 2 has 1 fields"},
        {"intensity,response\n-1,1\n\"-1,1\n", "line 3 has a stray or unclosed quote"},
    };
    for (const auto& [input, names] : bad) {
        const CommandResult result = quest("--json", input);
        EXPECT_EQ(result.exit_code, 2) << input;
        EXPECT_TRUE(is_one_error_line(result.errors)) << result.errors;
        EXPECT_NE(result.errors.find(names), std::string::npos) << result.errors;
        EXPECT_EQ(result.output, "");
    }
}

TEST_F(QuestCommand, RefusesImpossibleSettings) {
    const std::pair<const char*, const char*> bad[] = {
        {"--guess nan", "--guess"},
        {"--guess inf", "--guess"},
        {"--guess-sd 0", "--guess-sd"},
        {"--guess-sd=-1", "--guess-sd"},
        {"--beta 0", "--beta"},
        {"--beta inf", "--beta"},
        {"--gamma 1", "--gamma"},
        {"--gamma=-0.1", "--gamma"},
        {"--delta 1", "--delta"},
        {"--delta nan", "--delta"},
        {"--p-threshold 1", "--p-threshold"},
        {"--p-threshold 0.4", "--p-threshold"},
        {"--gamma 0.9", "--p-threshold"},
        {"--grain 0", "--grain"},
        {"--grain 100", "grain"},
        {"--range=-1", "--range"},
        {"--range 1e9", "--range"},
        {"--range 0.001 --engine stairstep", "--range"},
        {"--quantile-order 2", "--quantile-order"},
        {"--engine other", "--engine"},
        {"--range 0.02 --p-threshold 0.9", "p-threshold"},
    };
    for (const auto& [flags, names] : bad) {
        const CommandResult result = quest(flags, "intensity,response\n-1,1\n");
        EXPECT_EQ(result.exit_code, 2) << flags;
        EXPECT_TRUE(is_one_error_line(result.errors)) << result.errors;
        EXPECT_NE(result.errors.find(names), std::string::npos) << result.errors;
    }
}

TEST_F(QuestCommand, RefusesATerminal) {
    // script gives the program a terminal for all three streams, so its error comes back as the output.
    const CommandResult result = run_command("script -qec '" + program("stairstep-study") + " quest' /dev/null");
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_NE(result.output.find("error: standard input: is a terminal"), std::string::npos) << result.output;
}

TEST_F(QuestCommand, StreamsManyTrials) {
    std::string input = "intensity,response\n";
    for (int i = 0; i < 300000; ++i) input += i % 4 == 0 ? "-1.1,0\n" : "-0.9,1\n";
    const CommandResult result = quest("--json", input);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(nlohmann::json::parse(result.output).at("trials"), 300000);
}

}  // namespace
}  // namespace stairstep
