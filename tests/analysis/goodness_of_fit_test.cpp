#include "analysis/goodness_of_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

PsychometricFit truth() {
    PsychometricFit fit;
    fit.settings.p_threshold = 0.75;
    fit.parameters = {0, 3, 0.01, 0.5};
    fit.estimated = true;
    return fit;
}

/// Answers to nine strengths, whose threshold moves by `drift` from first to last.
std::vector<Answer01> answers_of(int count, double drift, uint64_t seed) {
    Random random(seed);
    const PsychometricFit function = truth();
    std::vector<Answer01> answers;
    for (int i = 0; i < count; ++i) {
        const double x = -0.4 + 0.1 * static_cast<double>(random.below(9));
        const double moved = x - drift * (static_cast<double>(i) / count - 0.5);
        answers.push_back({x, random.uniform() < function.probability(moved)});
    }
    return answers;
}

TEST(GoodnessOfFit, IsSatisfiedByWhatTheFunctionMade) {
    // p-values of fits to a function's own answers are uniform: of 40, few below .05 and about half below .5.
    int small = 0, below_half = 0;
    for (uint64_t seed = 0; seed < 40; ++seed) {
        const auto answers = answers_of(200, 0, seed);
        const GoodnessOfFit check = check_fit(fit_psychometric(answers, {}), answers, 39, seed);
        small += check.deviance.p_value <= 0.05;
        below_half += check.deviance.p_value < 0.5;
    }
    EXPECT_LE(small, 7);
    EXPECT_GE(below_half, 9);
    EXPECT_LE(below_half, 31);
}

TEST(GoodnessOfFit, SeesDrift) {
    const auto answers = answers_of(600, 0.6, 1);
    const GoodnessOfFit check = check_fit(fit_psychometric(answers, {}), answers, 99, 1);
    EXPECT_LE(check.residual_with_order.p_value, 0.02);
    EXPECT_LT(check.residual_with_order.observed, 0);  // it becomes harder
    const auto steady = answers_of(600, 0, 1);
    EXPECT_GT(check_fit(fit_psychometric(steady, {}), steady, 99, 1).residual_with_order.p_value, 0.02);
}

TEST(GoodnessOfFit, NamesATrialThatCarriesTheThreshold) {
    auto answers = answers_of(80, 0, 5);
    answers.push_back({0.9, false});  // a slip of the finger where no lapses are allowed for
    const PsychometricFitSettings settings{.largest_lapse = 0};
    const PsychometricFit fit = fit_psychometric(answers, settings);
    const GoodnessOfFit check = check_fit(fit, answers, 0, 1);
    ASSERT_FALSE(check.influential.empty());
    EXPECT_EQ(check.influential.front().index, 80u);
    EXPECT_GT(check.influential.front().deviance_drop, 1);
    // What is said of it is what a fit without it finds.
    answers.pop_back();
    const PsychometricFit without = fit_psychometric(answers, settings);
    EXPECT_NEAR(check.influential.front().threshold_shift, without.parameters.threshold - fit.parameters.threshold,
                1e-5);
}

TEST(GoodnessOfFit, OneStepIsCloseToLeavingOut) {
    const auto answers = answers_of(400, 0, 7);
    const PsychometricFit fit = fit_psychometric(answers, {});
    ASSERT_TRUE(fit.threshold_sd());
    for (size_t i = 0; i < 20; ++i) {
        auto rest = answers;
        rest.erase(rest.begin() + static_cast<long>(i));
        const double shift = fit_psychometric(rest, {}).parameters.threshold - fit.parameters.threshold;
        EXPECT_NEAR(one_step_threshold_shift(fit, answers[i]), shift, 0.05 * *fit.threshold_sd()) << i;
    }
}

TEST(GoodnessOfFit, RefusesWhatWasNotFitted) {
    const std::vector<Answer01> answers{{0, true}};
    EXPECT_THROW(check_fit(fit_psychometric(answers, {}), answers, 10, 1), InputError);
}

TEST(Correlation, OfLinesAndConstants) {
    EXPECT_NEAR(correlation({1, 2, 3}, {-2, -4, -6}), -1, 1e-15);
    EXPECT_EQ(correlation({1, 2, 3}, {5, 5, 5}), 0);
    EXPECT_EQ(correlation({}, {}), 0);
}

}  // namespace
}  // namespace stairstep
