#include "analysis/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "analysis/report_page.h"
#include "analysis/report_renderings.h"
#include "stimuli/error.h"
#include "stimuli/io/csv.h"
#include "stimuli/io/image_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "tests/analysis/simulated_trials.h"

namespace stairstep {
namespace {

/// Few simulations and a small picture: what a report holds doesn't depend on them.
ReportInputs quick_inputs() {
    ReportInputs inputs;
    inputs.background.design = small_design();
    inputs.background.observer_kind = "simulated";
    inputs.background.seeds = {7};
    inputs.check.simulations = 9;
    return inputs;
}

/// Whether "nan" or "inf" stands in a text as a word.
bool has_no_number(const std::string& text) {
    std::string lower = text;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto is_letter = [&](size_t i) {
        return i < lower.size() && std::isalpha(static_cast<unsigned char>(lower[i]));
    };
    for (const std::string word : {"nan", "inf"}) {
        for (size_t at = 0; (at = lower.find(word, at)) != std::string::npos; ++at) {
            if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + word.size())) return true;
        }
    }
    return false;
}

void expect_sound(const Report& report) {
    EXPECT_EQ(report.html.find("{{"), std::string::npos);
    EXPECT_FALSE(has_no_number(report.html));
    for (const char* reference : {"src=\"http", "href=\"http", "@import", "url(http", "<link"}) {
        EXPECT_EQ(report.html.find(reference), std::string::npos) << reference;
    }
    std::set<std::string> names;
    for (const auto& [name, text] : report.files) {
        EXPECT_TRUE(names.insert(name).second) << name << " twice";
        EXPECT_FALSE(text.empty()) << name;
        EXPECT_FALSE(has_no_number(text)) << name;
        if (name.ends_with(".csv")) {
            EXPECT_GT(CsvTable::parse(text, name).header().size(), 3u);
        }
        if (name.ends_with(".svg")) {
            EXPECT_NE(text.find("</svg>"), std::string::npos) << name;
            // Every figure is in the page as well.
            EXPECT_NE(report.html.find(inline_svg(text)), std::string::npos) << name;
        }
    }
}

const std::string& file_of(const Report& report, const std::string& name) {
    const auto found =
        std::find_if(report.files.begin(), report.files.end(), [&](const auto& file) { return file.first == name; });
    EXPECT_NE(found, report.files.end()) << name;
    return found->second;
}

class ReportTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        trials_ = simulated_trials(3, small_design(), 7, {}, "<'o_{{budget}} ");
        fit_ = fit_law(trials_, 0.82, "a & b");
        fit_.law.criteria = fit_criteria(trials_, {0.75, 0.82}, "a & b");
        report_ = make_report(trials_, fit_, quick_inputs());
    }

    inline static std::vector<Trial> trials_;
    inline static LawFit fit_;
    inline static Report report_;
    TemporaryFolder folder_;
};

TEST_F(ReportTest, IsWholeAndNeedsNoNetwork) {
    expect_sound(report_);
    EXPECT_NE(report_.html.find("&lt;'o_&#123;&#123;budget}} 0"), std::string::npos);
    EXPECT_EQ(report_.html.find("<'o_"), std::string::npos);
    for (const char* name : {"law.svg", "psychometric.svg", "psychometric-observers.svg", "convergence-01.svg",
                             "convergence-03.svg", "residuals.svg", "influence.svg", "reference.csv", "methods.txt"}) {
        EXPECT_FALSE(file_of(report_, name).empty());
    }
}

TEST_F(ReportTest, ItsTablesAreTheFits) {
    const CsvTable law = CsvTable::parse(file_of(report_, "law.csv"), "law.csv");
    ASSERT_EQ(law.row_count(), fit_.law.conditions.size());
    for (size_t row = 0; row < law.row_count(); ++row) {
        EXPECT_EQ(law.number(row, law.column("slope")), fit_.law.conditions[row].slope);
    }
    const CsvTable tracks = CsvTable::parse(file_of(report_, "convergence.csv"), "convergence.csv");
    ASSERT_EQ(tracks.row_count(), trials_.size());
    std::set<double> drawn, fitted;
    for (size_t row = 0; row < tracks.row_count(); ++row) {
        drawn.insert(tracks.number(row, tracks.column("threshold_px")));
        EXPECT_LT(tracks.number(row, tracks.column("threshold_low_px")),
                  tracks.number(row, tracks.column("threshold_high_px")));
    }
    for (const Threshold& t : fit_.thresholds) fitted.insert(t.radius_px());
    EXPECT_EQ(drawn, fitted);
    const CsvTable sensitivity = CsvTable::parse(file_of(report_, "sensitivity.csv"), "sensitivity.csv");
    double total = 0;
    const size_t last = sensitivity.row_count() - 1;
    for (const char* column : {"artifacts", "lines"}) total += sensitivity.number(last, sensitivity.column(column));
    EXPECT_EQ(total, static_cast<double>(trials_.size()));
    const CsvTable criteria = CsvTable::parse(file_of(report_, "criteria.csv"), "criteria.csv");
    ASSERT_EQ(criteria.row_count(), 2u);
    EXPECT_EQ(criteria.number(0, criteria.column("slope")), fit_.law.criteria[0].slope);
}

TEST_F(ReportTest, MethodsSayWhatWasDone) {
    const std::string& methods = file_of(report_, "methods.txt");
    for (const char* part : {"3 simulated observers", "patterns stair and step", "5 and 10 px", "quest", "160 × 120 px",
                             "sandwich", "Ceres Solver 2", "gnuplot 5", "82 %", "9 simulations",
                             "Seeds of the sessions: 7", "480 trials of 12 tracks"}) {
        EXPECT_NE(methods.find(part), std::string::npos) << part << "\n" << methods;
    }
}

TEST_F(ReportTest, IsTheSameOnAnyNumberOfThreads) {
    ReportInputs inputs = quick_inputs();
    inputs.check.jobs = 3;
    const Report again = make_report(trials_, fit_, inputs);
    EXPECT_EQ(again.files, report_.files);
}

TEST_F(ReportTest, ShowsWhatOtherStagesMade) {
    write_png(folder_.path() / "sheet.png", Image(8, 8, 1));
    const std::string section = contact_sheet_section((folder_.path() / "sheet.png").string());
    EXPECT_NE(section.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
}

/// Observers who are always right, or always wrong, in one condition have no threshold and no curve there.
TEST_F(ReportTest, CopesWithObserversWhoAreAlwaysRightOrAlwaysWrong) {
    for (const bool right : {true, false}) {
        std::vector<Trial> trials = trials_;
        const std::string observer = trials.front().observer;
        for (Trial& t : trials) {
            if (t.observer != observer || t.condition.pattern != Pattern::step) continue;
            t.response = right ? t.stimulus : (t.stimulus == Judgement::line ? Judgement::artifact : Judgement::line);
        }
        const LawFit fit = fit_law(trials, 0.82, "a");
        const Report report = make_report(trials, fit, quick_inputs());
        expect_sound(report);
        const std::string expected = right ? "all answers right" : "all answers wrong";
        EXPECT_NE(file_of(report, "psychometric-fits.csv").find(expected), std::string::npos);
    }
}

TEST_F(ReportTest, CopesWithOneSizeFewTrialsAndNoDesign) {
    std::vector<Trial> trials = trials_;
    std::erase_if(trials, [](const Trial& t) {
        return t.condition.texel_px != 5 || t.condition.pattern != Pattern::step || t.trial > 30;
    });
    expect_sound(make_report(trials, fit_law(trials, 0.82, "a"), {.picture = {160, 120}, .check = {.simulations = 0}}));
}

/// A track of one trial beside whole ones, and an observer of whom there is nothing else.
TEST_F(ReportTest, CopesWithSingleTrials) {
    std::vector<Trial> trials = trials_;
    Trial single = trials.front();
    single.observer = "only once";
    trials.push_back(single);
    single.observer = trials.front().observer;
    single.condition.contrast = 0.25;
    trials.push_back(single);
    expect_sound(make_report(trials, fit_law(trials, 0.82, "a"), quick_inputs()));
}

TEST_F(ReportTest, RefusesInputsThatAreNotWhatTheyShouldBe) {
    const auto file = [this](const char* name, const std::string& text) {
        write_file(folder_.path() / name, text);
        return (folder_.path() / name).string();
    };
    EXPECT_THROW(make_report(trials_, fit_, {file("sheet.png", "no picture"), ""}), InputError);
    EXPECT_THROW(make_report(trials_, fit_, {"absent.png", ""}), InputError);
    EXPECT_THROW(make_report(trials_, fit_, {"", "absent.json"}), InputError);
    for (const char* stats : {"{", "{}", R"({"renderings":[]})", R"({"renderings":[1]})", R"({"renderings":[{}]})",
                              R"({"renderings":[{"resolution":"auto","file":"absent.png"}]})"}) {
        EXPECT_THROW(make_report(trials_, fit_, {"", file("stats.json", stats)}), InputError) << stats;
    }
}

}  // namespace
}  // namespace stairstep
