// stairstep-render stress from the command line: exit codes, files, and the one line an error is.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "stimuli/io/csv.h"
#include "stimuli/io/json_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/number.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

class StressProgram : public testing::Test {
  protected:
    CommandResult run(const std::string& arguments) const {
        return run_command(program("stairstep-render") + " stress --out " + out().string() + " " + arguments);
    }
    std::filesystem::path out() const { return folder_.path() / "out"; }

    TemporaryFolder folder_;
};

TEST_F(StressProgram, RefusesBadInput) {
    for (const std::string arguments :
         {"--techniques fog", "--only fog", "--only \"frames;fog\"", "--techniques hard,hard", "--techniques \"\"",
          "--size 0x1", "--context metal"}) {
        const CommandResult outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.errors;
        EXPECT_TRUE(is_one_error_line(outcome.errors)) << arguments << "\n" << outcome.errors;
        EXPECT_FALSE(std::filesystem::exists(out())) << arguments;
    }
    EXPECT_EQ(run_command(program("stairstep-render") + " stress").exit_code, 2);
}

TEST_F(StressProgram, SaysWhatItCannotWrite) {
    write_file(out(), "a file, no folder");
    const CommandResult outcome = run("--quick --techniques hard --size 32x18");
    EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
    EXPECT_TRUE(is_one_error_line(outcome.errors)) << outcome.errors;
}

TEST_F(StressProgram, WritesATableAndAPage) {
    const CommandResult outcome = run("--quick --techniques none,hard --size 32x18 --json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const nlohmann::json json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["broken"], 0);
    const CsvTable csv = CsvTable::read(out() / "stress.csv");
    EXPECT_EQ(csv.row_count(), json["rows"].size());
    EXPECT_GE(csv.row_count(), 40u);
    for (const char* column :
         {"condition", "error_rmse", "nan_pixels", "gl_errors", "acne_share", "detachment_texels"}) {
        EXPECT_TRUE(csv.find_column(column)) << column;
    }
    // No more than a row a condition below the head, and a column a technique; each condition is in one of them.
    const std::vector<std::string> lines = split(read_file(out() / "stress.md"), '\n');
    EXPECT_LE(lines.size(), 2 + csv.row_count() / 2 + 1);
    EXPECT_EQ(lines.front(), "| condition | none | hard |");
    const std::string page = read_file(out() / "index.html");
    EXPECT_NE(page.find("</html>"), std::string::npos);
    // Nothing from a network, and no place left open.
    EXPECT_EQ(page.find("http"), std::string::npos);
    EXPECT_EQ(page.find("{{"), std::string::npos);
}

}  // namespace
}  // namespace stairstep
