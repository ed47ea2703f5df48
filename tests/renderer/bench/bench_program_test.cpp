// stairstep-render bench from the command line: exit codes and the one line an error is.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "stimuli/io/json_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

class BenchProgram : public testing::Test {
  protected:
    CommandResult run(const std::string& arguments) const {
        return run_command(program("stairstep-render") + " bench --cache " + (folder_.path() / "cache").string() +
                           " --out " + out().string() + " " + arguments);
    }
    std::filesystem::path out() const { return folder_.path() / "out"; }

    TemporaryFolder folder_;
};

TEST_F(BenchProgram, RefusesBadInput) {
    for (const std::string arguments :
         {"--scenes castle", "--scenes \"\"", "--size 0x1", "--size 64x64x64", "--wobble-size 1e9x1", "--samples 10",
          "--frames 0", "--radius nan", "--law none.json", "--context metal"}) {
        const CommandResult outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.errors;
        EXPECT_TRUE(is_one_error_line(outcome.errors)) << arguments << "\n" << outcome.errors;
        EXPECT_EQ(outcome.output, "");
        EXPECT_FALSE(std::filesystem::exists(out())) << arguments;
    }
    EXPECT_EQ(run_command(program("stairstep-render") + " bench").exit_code, 2);
}

TEST_F(BenchProgram, SaysWhatItCannotWrite) {
    write_file(out(), "a file, no folder");
    const CommandResult outcome = run("--quick --scenes crane --size 32x18");
    EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
    EXPECT_TRUE(is_one_error_line(outcome.errors)) << outcome.errors;
}

TEST_F(BenchProgram, QuickPrintsTheBars) {
    const CommandResult outcome =
        run("--quick --scenes crane --size 64x36 --frames 1 --samples 16 --no-wobble --largest-size 512 --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const nlohmann::json json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["scenes"][0]["scene"], "crane");
    EXPECT_EQ(json["scenes"][0]["configurations"], 14);
    EXPECT_EQ(json["scenes"][0]["bars"].size(), 7u);
    EXPECT_TRUE(std::filesystem::exists(out() / "index.html"));
}

}  // namespace
}  // namespace stairstep
