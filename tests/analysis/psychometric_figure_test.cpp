#include "analysis/psychometric_figure.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "stimuli/io/csv.h"
#include "tests/analysis/simulated_trials.h"

namespace stairstep {
namespace {

RC_GTEST_PROP(Binned, BinsHoldEveryTrialOnceAndAreOrdered, ()) {
    const auto hundredths = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-200, 200)));
    const int least = *rc::gen::inRange(1, 20);
    std::vector<double> strengths;
    std::vector<Trial> trials;
    int right = 0;
    for (const int h : hundredths) {
        strengths.push_back(h / 100.0);
        Trial trial;
        trial.stimulus = h % 2 == 0 ? Judgement::artifact : Judgement::line;
        trial.response = h % 3 == 0 ? Judgement::artifact : Judgement::line;
        right += trial.correct();
        trials.push_back(trial);
    }
    const std::vector<ResponseBin> bins = binned(strengths, trials, 0.15, least);
    int counted = 0, counted_right = 0;
    double sum = 0;
    for (size_t i = 0; i < bins.size(); ++i) {
        RC_ASSERT(bins[i].trials > 0);
        RC_ASSERT(bins[i].counts.artifacts + bins[i].counts.lines == bins[i].trials);
        RC_ASSERT(bins[i].counts.hits + bins[i].counts.lines - bins[i].counts.false_alarms == bins[i].right);
        if (i > 0) RC_ASSERT(bins[i - 1].strength < bins[i].strength);
        counted += bins[i].trials;
        counted_right += bins[i].right;
        sum += bins[i].strength * bins[i].trials;
    }
    if (bins.size() > 1) RC_ASSERT(bins.front().trials >= least && bins.back().trials >= least);
    RC_ASSERT(counted == static_cast<int>(trials.size()));
    RC_ASSERT(counted_right == right);
    double all = 0;
    for (const double x : strengths) all += x;
    RC_ASSERT(std::abs(sum - all) < 1e-9 * (1 + std::abs(all)));
}

TEST(PsychometricCsv, HasTheTrialsOfEachConditionTwiceAndTheFitsShares) {
    const std::vector<Trial> trials = simulated_trials(3, small_design());
    const StudyCheck check = check_study(trials, fit_law(trials, 0.82, "simulated"), {.simulations = 0});
    const CsvTable table = CsvTable::parse(psychometric_csv(check), "psychometric.csv");
    const auto number = [&](size_t row, const char* column) { return table.number(row, table.column(column)); };
    double pooled = 0, single = 0;
    for (size_t row = 0; row < table.row_count(); ++row) {
        const std::string observer = table.text(row, table.column("observer"));
        (observer.empty() ? pooled : single) += number(row, "trials");
        EXPECT_LE(number(row, "right_low"), number(row, "right") / number(row, "trials"));
        EXPECT_GE(number(row, "right_high"), number(row, "right") / number(row, "trials"));
        for (const ObserverCurve& curve : check.curves) {
            if (curve.observer != observer ||
                name(curve.condition.pattern) != table.text(row, table.column("pattern"))) {
                continue;
            }
            EXPECT_EQ(number(row, "fitted"), curve.fit.probability(number(row, "strength")));
        }
    }
    EXPECT_EQ(pooled, static_cast<double>(trials.size()));
    EXPECT_EQ(single, static_cast<double>(trials.size()));

    const CsvTable fits = CsvTable::parse(psychometric_fits_csv(check), "psychometric-fits.csv");
    ASSERT_EQ(fits.row_count(), check.curves.size());
    for (size_t row = 0; row < fits.row_count(); ++row) {
        EXPECT_EQ(fits.number(row, fits.column("threshold")), check.curves[row].fit.parameters.threshold);
    }
}

}  // namespace
}  // namespace stairstep
