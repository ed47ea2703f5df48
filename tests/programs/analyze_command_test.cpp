// stairstep-analyze fit and report as a user runs them.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/law/law_file.h"
#include "stimuli/io/csv.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

class Analyze : public testing::Test {
  protected:
    static CommandResult run(const std::string& command) {
        return run_command("cd " + folder_->path().string() + " && PATH=" + STAIRSTEP_BIN_DIR + ":$PATH && " + command);
    }
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TemporaryFolder>();
        write_file(file("design.json"),
                   R"({"patterns": ["stair"], "contrasts": [1], "texels_px": [5, 10], "stop": {"most_trials": 50}})");
        ASSERT_EQ(run("stairstep-study simulate --observers 3 --seed 5 --design design.json --db s.sqlite && "
                      "stairstep-study export --db s.sqlite --out .")
                      .exit_code,
                  0);
    }
    static void TearDownTestSuite() { folder_.reset(); }
    static std::filesystem::path file(const std::string& name) { return folder_->path() / name; }
    static nlohmann::json law(const std::string& name) { return nlohmann::json::parse(read_file(file(name))); }

    inline static std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(Analyze, TheLawFileIsForTheCriterionThatIsNamedOrTheFirst) {
    const std::string fit = "stairstep-analyze fit s.sqlite --bootstrap 0 --simulations 0 ";
    ASSERT_EQ(run(fit + "--p 0.75,0.9 --out first.json").exit_code, 0);
    ASSERT_EQ(run(fit + "--p 0.75,0.9 --out-p 0.9 --out named.json").exit_code, 0);
    ASSERT_EQ(run(fit + "--p 0.9 --out single.json").exit_code, 0);
    EXPECT_EQ(law("first.json")["threshold_probability"], 0.75);
    EXPECT_EQ(law("named.json")["threshold_probability"], 0.9);
    EXPECT_EQ(law("named.json")["slope"], law("single.json")["slope"]);
    EXPECT_EQ(law("named.json")["criteria"].size(), 2u);
    EXPECT_GT(law("first.json")["slope"], law("named.json")["slope"]) << "what is seen less often takes more filter";
}

TEST_F(Analyze, AFitStatesItsChecksAfterTheLaw) {
    const CommandResult printed = run("stairstep-analyze fit s.sqlite --bootstrap 0 --simulations 50 --out law.json");
    ASSERT_EQ(printed.exit_code, 0) << printed.errors;
    for (const char* part : {"goodness of fit", "overdispersion", "d' ", "criterion ", "lapses"}) {
        EXPECT_NE(printed.output.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(read_law(file("law.json")).observers, 3) << "readers of laws ignore the checks";
    const nlohmann::json checks = law("law.json")["checks"];
    EXPECT_EQ(checks["simulations"], 50);
    ASSERT_EQ(checks["observers"].size(), 3u);
    for (const auto& observer : checks["observers"]) {
        EXPECT_LT(observer["d_prime_ci95"][0], observer["d_prime"]);
        EXPECT_GT(observer["d_prime_ci95"][1], observer["d_prime"]);
    }
    ASSERT_EQ(checks["conditions"].size(), 1u);
    for (const auto& condition : checks["conditions"]) {
        EXPECT_GT(condition["deviance_p"], 0);
        EXPECT_LE(condition["deviance_p"], 1);
        EXPECT_TRUE(condition["overdispersion"].is_null());
    }
    ASSERT_EQ(
        run("stairstep-analyze fit s.sqlite --bootstrap 0 --simulations 0 --json --out none.json >out.json").exit_code,
        0);
    EXPECT_EQ(read_file(file("out.json")), read_file(file("none.json")));
    EXPECT_TRUE(law("none.json")["checks"]["conditions"][0]["deviance_p"].is_null());
}

TEST_F(Analyze, AReportOfADatabaseAndOfItsTableAgreeAndHaveNoNan) {
    ASSERT_EQ(run("stairstep-analyze report s.sqlite --simulations 20 --out a").exit_code, 0);
    ASSERT_EQ(run("stairstep-analyze report trials.csv --simulations 20 --out b").exit_code, 0);
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(file("a"))) {
        const std::string name = entry.path().filename().string();
        names.insert(name);
        ASSERT_TRUE(std::filesystem::exists(file("b/" + name))) << name;
        if (name.ends_with(".csv")) {
            EXPECT_EQ(read_file(entry.path()), read_file(file("b/" + name))) << name;
            EXPECT_EQ(read_file(entry.path()).find("nan"), std::string::npos) << name;
        }
    }
    for (const char* name : {"report.html", "law.svg", "psychometric.svg", "residuals.svg", "influence.svg",
                             "convergence-01.svg", "convergence-03.svg", "methods.txt"}) {
        EXPECT_TRUE(names.contains(name)) << name;
    }
    const CsvTable criteria = CsvTable::read(file("a/criteria.csv"));
    EXPECT_EQ(criteria.row_count(), 3u);
}

TEST_F(Analyze, StudiesThatSayNothingGetAPlainError) {
    run("head -2 trials.csv >one-trial.csv; grep -e ^study -e sim01 trials.csv >one-observer.csv; "
        "awk -F, -v OFS=, 'NR > 1 {$14 = $13} {print}' trials.csv >all-right.csv");
    for (const char* name : {"one-trial", "one-observer", "all-right"}) {
        for (const char* command : {"report", "fit"}) {
            const CommandResult result = run(std::string("stairstep-analyze ") + command + " " + name + ".csv --out x");
            EXPECT_EQ(result.exit_code, 1) << name << result.errors;
            EXPECT_TRUE(is_one_error_line(result.errors)) << result.errors;
            EXPECT_FALSE(std::filesystem::exists(file("x"))) << name;
        }
    }
}

}  // namespace
}  // namespace stairstep
