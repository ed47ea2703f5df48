// stairstep-render scaling from the command line: exit codes, and what it prints.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "stimuli/io/temporary_folder.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

class ScalingProgram : public testing::Test {
  protected:
    CommandResult run(const std::string& arguments) const {
        return run_command(program("stairstep-render") + " scaling --out " + out().string() + " " + arguments);
    }
    std::filesystem::path out() const { return folder_.path() / "out"; }

    TemporaryFolder folder_;
};

TEST_F(ScalingProgram, RefusesBadInput) {
    for (const std::string arguments : {"--axes colour", "--axes \"\"", "--axes radius,radius", "--axes radius,",
                                        "--size 0x1", "--frames 0", "--context metal"}) {
        const CommandResult outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.errors;
        EXPECT_TRUE(is_one_error_line(outcome.errors)) << arguments << "\n" << outcome.errors;
        EXPECT_EQ(outcome.output, "");
        EXPECT_FALSE(std::filesystem::exists(out())) << arguments;
    }
    EXPECT_EQ(run_command(program("stairstep-render") + " scaling").exit_code, 2);
}

TEST_F(ScalingProgram, QuickPrintsExponents) {
    const CommandResult outcome = run("--quick --axes radius --size 64x36 --frames 1 --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const nlohmann::json json = nlohmann::json::parse(outcome.output);
    ASSERT_EQ(json["axes"].size(), 1u);
    EXPECT_EQ(json["axes"][0]["axis"], "radius");
    EXPECT_EQ(json["axes"][0]["techniques"].size(), 3u);
    EXPECT_EQ(json["frames"], 1);
    for (const char* file : {"scaling.csv", "index.html", "radius.svg"}) {
        EXPECT_TRUE(std::filesystem::exists(out() / file)) << file;
    }
}

}  // namespace
}  // namespace stairstep
