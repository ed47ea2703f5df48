// Coverage and power, counted over studies whose truth is known.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/coverage.h"
#include "analysis/power.h"
#include "analysis/result_csv.h"
#include "stimuli/error.h"
#include "stimuli/io/csv.h"

namespace stairstep {
namespace {

constexpr CoverageSettings kFew{.studies = 16, .seed = 3, .jobs = 2};

TEST(PlantedStudy, IsWholeAndTheSameForTheSameSeed) {
    PlantedStudy study;
    study.observers = 3;
    study.design.patterns = {Pattern::stair};
    const std::vector<Trial> trials = simulate_study(study, 5);
    EXPECT_EQ(trials.size(), 3u * 2 * 4 * 40);
    const std::vector<Trial> again = simulate_study(study, 5);
    const std::vector<Trial> other = simulate_study(study, 6);
    int differences = 0;
    for (size_t i = 0; i < trials.size(); ++i) {
        EXPECT_EQ(trials[i].radius_px, again[i].radius_px);
        differences += trials[i].radius_px != other[i].radius_px;
    }
    EXPECT_GT(differences, 800);
}

TEST(Coverage, CountsEveryMethodAlikeOnAnyNumberOfThreads) {
    const CoverageCell cell = usual_cells().front();
    CoverageSettings one = kFew;
    one.jobs = 1;
    const CellCoverage a = coverage_of(cell, kFew);
    const CellCoverage b = coverage_of(cell, one);
    ASSERT_GE(a.methods.size(), 5u);
    ASSERT_EQ(a.methods.size(), b.methods.size());
    for (size_t i = 0; i < a.methods.size(); ++i) {
        EXPECT_EQ(a.methods[i].studies, 16);
        EXPECT_EQ(a.methods[i].coverage, b.methods[i].coverage);
        EXPECT_EQ(a.methods[i].bias, b.methods[i].bias);
        // 16 studies: what is grossly wrong shows. The SD of ln c is .055, that of its mean .014.
        EXPECT_GE(a.methods[i].coverage, 0.7) << a.methods[i].method;
        EXPECT_LT(std::abs(a.methods[i].bias), 0.08) << a.methods[i].method;
        EXPECT_NEAR(a.methods[i].sd, 0.055, 0.03);
    }
}

TEST(Coverage, SaysWhatIsOffTarget) {
    EXPECT_TRUE((MethodCoverage{.coverage = 0.95, .coverage_se = 0.001}).is_on_target());
    EXPECT_TRUE((MethodCoverage{.coverage = 0.92, .coverage_se = 0.006}).is_on_target());
    EXPECT_FALSE((MethodCoverage{.coverage = 0.92, .coverage_se = 0.004}).is_on_target());
    EXPECT_FALSE((MethodCoverage{.coverage = 0.99, .coverage_se = 0.002}).is_on_target());
}

TEST(Coverage, CellsDifferFromTheUsualStudyInOneThing) {
    const auto cells = usual_cells();
    EXPECT_GE(cells.size(), 10u);
    for (const CoverageCell& cell : cells) {
        EXPECT_EQ(cell.study.design.patterns, std::vector{Pattern::step});
        EXPECT_EQ(cell.study.design.contrasts, std::vector{1.0});
    }
}

TEST(Power, FindsALargeEffectAndSeldomNone) {
    const StudyPlan plan{.observers = 8, .trials_a_track = 40, .texels_px = {5, 10, 20}};
    const auto exponent = parse_effect("exponent=0.6");
    EXPECT_GE(power_of(plan, exponent, {}, kFew).power(), 0.9);
    const auto ratio = parse_effect("slope-ratio=0.6");
    EXPECT_GE(power_of(plan, ratio, {}, kFew).power(), 0.9);
    // False alarms come in 5 %: more than 4 of 16 less than once in a thousand times.
    EXPECT_LE(power_of(plan, parse_effect("slope-ratio=1"), {}, kFew).found, 4);
    EXPECT_LE(power_of(plan, parse_effect("exponent=1"), {}, kFew).found, 4);
}

TEST(Power, StatesThePlanInASentence) {
    const Power power{{.observers = 12, .trials_a_track = 40, .texels_px = {5, 10, 20}}, 500, 420};
    const std::string text = sentence(power, parse_effect("slope-ratio=0.9"), {}, {.studies = 500, .seed = 7});
    for (const char* part : {"12 observers", "40 trials", "3 texel sizes (5, 10 and 20 px)", "240 trials", "0.9",
                             "probability 0.84", "500 simulated studies", "seed 7"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
    }
    // Wilson's interval of 420 of 500: .805 to .870.
    EXPECT_NEAR(power.ci95().first, 0.805, 0.001);
    EXPECT_NEAR(power.ci95().second, 0.870, 0.001);
}

TEST(Power, RefusesWhatIsNoEffect) {
    for (const char* text : {"", "=", "slope-ratio", "slope-ratio=", "exponent=x", "exponent=9", "ratio=0.9"}) {
        EXPECT_THROW(parse_effect(text), InputError) << text;
    }
}

TEST(ResultCsv, HasARowAThresholdAndARowACondition) {
    PlantedStudy study;
    study.observers = 3;
    study.design.contrasts = {1};
    const LawFit fit = fit_law(simulate_study(study, 1), 0.82, "s");
    const CsvTable thresholds = CsvTable::parse(thresholds_csv(fit), "thresholds.csv");
    EXPECT_EQ(thresholds.row_count(), 3u * 2 * 4);
    for (size_t row = 0; row < thresholds.row_count(); ++row) {
        const double radius = thresholds.number(row, thresholds.column("radius_px"));
        EXPECT_LT(thresholds.number(row, thresholds.column("radius_low_px")), radius);
        EXPECT_GT(thresholds.number(row, thresholds.column("radius_high_px")), radius);
    }
    const CsvTable law = CsvTable::parse(law_csv(fit.law), "law.csv");
    ASSERT_EQ(law.row_count(), 2u);
    EXPECT_EQ(law.number(0, law.column("slope")), fit.law.conditions[0].slope);
}

}  // namespace
}  // namespace stairstep
