#include "analysis/residual_figure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/report_tables.h"
#include "tests/analysis/simulated_trials.h"

namespace stairstep {
namespace {

TEST(ResidualGroups, HaveEachAnswerOnceInEitherOrder) {
    const std::vector<Trial> trials = simulated_trials(2, small_design());
    const StudyCheck check = check_study(trials, fit_law(trials, 0.82, "simulated"), {.simulations = 0});
    const std::vector<ResidualGroup> groups = residual_groups(check);
    for (const ObserverCurve& curve : check.curves) {
        double predicted = 0;
        int right = 0;
        for (const Answer01& a : curve.answers) {
            predicted += curve.fit.probability(a.strength);
            right += a.correct;
        }
        for (const ResidualOrder order : {ResidualOrder::prediction, ResidualOrder::trial}) {
            int counted = 0, counted_right = 0;
            double expected = 0, last = -1;
            for (const ResidualGroup& g : groups) {
                if (g.observer != curve.observer || g.order != order ||
                    g.condition.pattern != curve.condition.pattern) {
                    continue;
                }
                EXPECT_NEAR(g.trials, kResidualGroupSize, kResidualGroupSize / 2);
                EXPECT_GE(g.position, last);
                // Σ of a binomial deviance: its sign says on which side the group is.
                EXPECT_GE(g.residual * (g.right - g.expected), 0);
                last = g.position;
                counted += g.trials;
                counted_right += g.right;
                expected += g.expected;
            }
            EXPECT_EQ(counted, static_cast<int>(curve.answers.size()));
            EXPECT_EQ(counted_right, right);
            EXPECT_NEAR(expected, predicted, 1e-9);
        }
    }
}

TEST(ResidualGroups, AreAboutStandardNormalWhereTheModelHolds) {
    const std::vector<Trial> trials = simulated_trials(12, small_design(), 21);
    const StudyCheck check = check_study(trials, fit_law(trials, 0.82, "simulated"), {.simulations = 0});
    double sum = 0, squares = 0, n = 0;
    for (const ResidualGroup& g : residual_groups(check)) {
        sum += g.residual;
        squares += g.residual * g.residual;
        ++n;
    }
    EXPECT_NEAR(sum / n, 0, 0.25);
    EXPECT_NEAR(std::sqrt(squares / n), 1, 0.2);
}

TEST(ResidualSentence, NamesWhatIsLarge) {
    ResidualGroup group{"anna", {}, ResidualOrder::trial, 12, 16, 2, 12, -5.4};
    EXPECT_NE(residual_sentence({group}).find("anna"), std::string::npos);
    group.residual = 2.9;
    EXPECT_EQ(residual_sentence({group}).find("anna"), std::string::npos);
}

}  // namespace
}  // namespace stairstep
