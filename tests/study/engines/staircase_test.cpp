#include "study/engines/staircase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

TEST(Staircase, KnowsWhereItsRulesConverge) {
    // Levitt (1971), table I: .707, .794, .841 for 2, 3, 4 down 1 up.
    EXPECT_NEAR(convergence_probability({.down_after = 1}), 0.5, 1e-15);
    EXPECT_NEAR(convergence_probability({.down_after = 2}), 0.707, 5e-4);
    EXPECT_NEAR(convergence_probability({.down_after = 3}), 0.794, 5e-4);
    EXPECT_NEAR(convergence_probability({.down_after = 4}), 0.841, 5e-4);
    // Kaernbach (1991): steps up three times as large as down converge at .75.
    EXPECT_DOUBLE_EQ(weighted_up_over_down(0.75), 3);
    EXPECT_NEAR(weighted_up_over_down(0.82), 4.556, 5e-4);
    EXPECT_NEAR(convergence_probability({.down_after = 1, .up_over_down = weighted_up_over_down(0.82)}), 0.82, 1e-15);
}

TEST(Staircase, FollowsItsRuleStepByStep) {
    // 2 down 1 up, answered as written; reversals at trials 4 (down to up), 6 (up to down) and 8.
    const std::string_view answers = "CCCxCCCxC";
    const std::vector<double> levels{0.4, 0.4, 0.2, 0.2, 0.3, 0.3, 0.25, 0.25, 0.3, 0.3};
    Staircase staircase({});
    for (size_t trial = 0; trial < answers.size(); ++trial) {
        EXPECT_NEAR(staircase.suggest(), levels[trial], 1e-12) << "trial " << trial;
        staircase.update(staircase.suggest(), answers[trial] == 'C');
    }
    EXPECT_NEAR(staircase.suggest(), levels.back(), 1e-12);
    EXPECT_EQ(staircase.reversals(), 3);
    EXPECT_EQ(staircase.trials(), 9);
}

TEST(Staircase, AveragesItsLastReversalsAndMovesThemToTheThreshold) {
    // Weighted for p_T itself: nothing to move. Reversals of the answers below: .2, .2 + 3·.1 and so on, by hand.
    StaircaseSettings settings{.down_after = 1, .up_over_down = 3, .steps = {0.1}, .averaged_reversals = 2};
    settings.posterior.shape.p_threshold = 0.75;
    Staircase staircase(settings);
    for (const bool correct : {true, true, false}) staircase.update(staircase.suggest(), correct);  // .4 .3 .2 → .5
    EXPECT_DOUBLE_EQ(staircase.estimate().threshold, [&] {  // one reversal: still the posterior mean
        Quest quest(settings.posterior);
        quest.update(0.4, true);
        quest.update(0.4 - 0.1, true);
        quest.update(0.4 - 0.1 - 0.1, false);
        return quest.mean();
    }());
    staircase.update(staircase.suggest(), true);  // at .5, a peak
    EXPECT_NEAR(staircase.estimate().threshold, (0.2 + 0.5) / 2, 1e-12);

    // The same trials for a threshold at another probability: moved by where the shape has .75.
    settings.posterior.shape.p_threshold = 0.82;
    Staircase other(settings);
    for (const bool correct : {true, true, false, true}) other.update(other.suggest(), correct);
    const double t = other.estimate().threshold;
    const PsychometricShape& shape = settings.posterior.shape;
    EXPECT_NEAR(probability_correct(shape, threshold_offset(shape), 0.35, t), 0.75, 1e-12);
}

TEST(Staircase, SaysHowFarItsThresholdIsFromWhatAllTrialsSay) {
    Staircase staircase({});
    Quest quest({});
    Random random(3);
    const PsychometricShape shape;
    for (int trial = 0; trial < 60; ++trial) {
        const double x = staircase.suggest();
        const bool correct = random.uniform() < probability_correct(shape, threshold_offset(shape), x, 0.1);
        staircase.update(x, correct);
        quest.update(x, correct);
    }
    const ThresholdEstimate said = staircase.estimate();
    const double off = said.threshold - quest.mean();
    EXPECT_NEAR(said.sd * said.sd, quest.sd() * quest.sd() + off * off, 1e-12);
    EXPECT_DOUBLE_EQ(said.low, quest.quantile(0.025));
    EXPECT_DOUBLE_EQ(said.high, quest.quantile(0.975));
}

TEST(Staircase, HoversWhereUpAndDownBalance) {
    // Small steps hug the balance: the share of right answers over a long run is p, Levitt's table again.
    for (const int down_after : {2, 3}) {
        StaircaseSettings settings{.down_after = down_after, .steps = {0.01}, .posterior = {.grain = 0.1}};
        Staircase staircase(settings);
        Random random(static_cast<uint64_t>(down_after));
        const PsychometricShape& shape = settings.posterior.shape;
        int right = 0;
        constexpr int kTrials = 10'000;
        for (int trial = 0; trial < 500 + kTrials; ++trial) {
            const double x = staircase.suggest();
            const bool correct = random.uniform() < probability_correct(shape, threshold_offset(shape), x, 0);
            staircase.update(x, correct);
            if (trial >= 500) right += correct;
        }
        EXPECT_NEAR(right / static_cast<double>(kTrials), convergence_probability(settings), 0.015) << down_after;
    }
}

TEST(Staircase, StepsFromWhatWasShownAndStaysInRange) {
    Staircase staircase({});
    staircase.update(0.1, false);
    EXPECT_NEAR(staircase.suggest(), 0.3, 1e-12);
    for (int i = 0; i < 100; ++i) staircase.update(staircase.suggest(), false);
    EXPECT_DOUBLE_EQ(staircase.suggest(), 2.5);
    staircase.update(-1e6, true);
    EXPECT_DOUBLE_EQ(staircase.suggest(), -2.5);
}

TEST(Staircase, RefusesImpossibleSettings) {
    EXPECT_THROW(Staircase({.start = NAN}), InputError);
    EXPECT_THROW(Staircase({.down_after = 0}), InputError);
    EXPECT_THROW(Staircase({.down_after = 1}), InputError);  // converges at .5, where Ψ never is
    EXPECT_THROW(Staircase({.up_over_down = 0}), InputError);
    EXPECT_THROW(Staircase({.steps = {}}), InputError);
    EXPECT_THROW(Staircase({.steps = {0.1, -0.1}}), InputError);
    EXPECT_THROW(Staircase({.averaged_reversals = 3}), InputError);
    EXPECT_THROW(Staircase({.posterior = {.grain = 0}}), InputError);
}

}  // namespace
}  // namespace stairstep
