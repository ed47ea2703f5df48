#include "analysis/study_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/analysis/planted_thresholds.h"
#include "tests/analysis/simulated_trials.h"

namespace stairstep {
namespace {

TEST(FisherCombined, HasItsClosedForms) {
    // Two: P(product of two uniforms ≤ k) = k(1 − ln k).
    EXPECT_NEAR(*fisher_combined({0.05, 0.05}), 0.0025 * (1 - std::log(0.0025)), 1e-12);
    EXPECT_NEAR(*fisher_combined({0.3}), 0.3, 1e-12);
    EXPECT_NEAR(*fisher_combined({1, 1, 1}), 1, 1e-12);
    EXPECT_FALSE(fisher_combined({}).has_value());
    EXPECT_NEAR(chi2_upper_p(3.841459, 1), 0.05, 1e-7);
}

TEST(StudyCheck, CountsEveryTrialOnceAndAlignsOnTheLaw) {
    const std::vector<Trial> trials = simulated_trials(3, small_design());
    const LawFit fit = fit_law(trials, 0.82, "simulated");
    const StudyCheck check = check_study(trials, fit, {.simulations = 0});
    ASSERT_EQ(check.curves.size(), 6u);
    ASSERT_EQ(check.observers.size(), 3u);
    ASSERT_EQ(check.conditions.size(), fit.law.conditions.size());
    size_t answers = 0;
    for (const ObserverCurve& curve : check.curves) {
        answers += curve.answers.size();
        ASSERT_EQ(curve.trials.size(), curve.answers.size());
        EXPECT_FALSE(curve.goodness.has_value());
        ASSERT_TRUE(curve.log_slope.has_value());
        // Two ways to one threshold: maximum likelihood over all sizes, and the law over each size's posterior.
        EXPECT_NEAR(curve.fit.parameters.threshold, -*curve.log_slope, 0.1) << curve.observer;
    }
    EXPECT_EQ(answers, trials.size());
    int counted = 0, right = 0;
    for (const ObserverCheck& o : check.observers) {
        counted += o.trials;
        right += o.right;
        EXPECT_EQ(o.sensitivity.counts.artifacts + o.sensitivity.counts.lines, o.trials);
        EXPECT_FALSE(o.least_deviance_p.has_value());
    }
    EXPECT_EQ(counted, static_cast<int>(trials.size()));
    EXPECT_EQ(right, std::count_if(trials.begin(), trials.end(), [](const Trial& t) { return t.correct(); }));
    for (const ConditionCheck& c : check.conditions) {
        ASSERT_TRUE(c.aligned && c.aligned->estimated);
        EXPECT_NEAR(c.aligned->parameters.threshold, 0, 0.05);
        EXPECT_FALSE(c.overdispersion.has_value()) << "an adaptive track says nothing about it";
        const auto bounded = std::count_if(fit.thresholds.begin(), fit.thresholds.end(), [&](const Threshold& t) {
            return t.bounded && t.condition.pattern == c.condition.pattern;
        });
        EXPECT_EQ(c.scatter_df, bounded - 3) << "a slope an observer is fitted";
    }
}

TEST(StudyCheck, IsTheSameOnAnyNumberOfThreadsAndAnotherWithAnotherSeed) {
    const std::vector<Trial> trials = simulated_trials(2, small_design());
    const LawFit fit = fit_law(trials, 0.82, "simulated");
    const auto text = [&](uint64_t seed, int jobs) {
        return to_json(check_study(trials, fit, {40, seed, jobs}))["conditions"].dump();
    };
    EXPECT_EQ(text(1, 1), text(1, 3));
    EXPECT_NE(text(1, 1), text(2, 1));
}

/// The first half of each observer's trials in a condition answered by somebody far better than the second half.
TEST(StudyCheck, SeesObserversWhoTireAndNotThoseWhoDoNot) {
    std::vector<Trial> trials = simulated_trials(3, small_design(), 11);
    const LawFit fit = fit_law(trials, 0.82, "simulated");
    const StudyCheck before = check_study(trials, fit, {.simulations = 99});
    for (const ConditionCheck& c : before.conditions) EXPECT_GT(*c.order_p, 0.01);
    Random random(3);
    for (Trial& trial : trials) {
        const bool right = trial.trial <= 20 || random.uniform() < 0.5;
        trial.response =
            right ? trial.stimulus : (trial.stimulus == Judgement::line ? Judgement::artifact : Judgement::line);
    }
    const StudyCheck after = check_study(trials, fit, {.simulations = 99});
    for (const ConditionCheck& c : after.conditions) EXPECT_LT(*c.order_p, 0.001);
}

TEST(StudyCheck, ScatterOfThresholdsIsAsTheirStandardDeviationsSayUnlessASizeIsOff) {
    PlantedStudy planted;
    planted.observers = 40;
    const std::vector<Threshold> thresholds = planted.thresholds(Random(5));
    // Trials only have to be there; the thresholds are what counts.
    const std::vector<Trial> trials = simulated_trials(2, small_design());
    const LawFit fit = fit_law_to_thresholds(thresholds, 0.82, "planted");
    for (const ConditionCheck& c : check_study(trials, fit, {.simulations = 0}).conditions) {
        EXPECT_EQ(c.scatter_df, 40 * 3);
        EXPECT_NEAR(c.scatter_chi2 / c.scatter_df, 1, 0.4);
        EXPECT_GT(*c.scatter_p, 0.001);
    }
    std::vector<Threshold> off = thresholds;
    for (Threshold& t : off) {
        if (t.condition.texel_px == 30) t.log_threshold += 0.2;
    }
    const LawFit bent = fit_law_to_thresholds(off, 0.82, "planted");
    for (const ConditionCheck& c : check_study(trials, bent, {.simulations = 0}).conditions) {
        EXPECT_LT(*c.scatter_p, 1e-6);
    }
}

TEST(StudyCheck, EstimatesOverdispersionWhereStrengthsRepeat) {
    std::vector<Trial> trials;
    Random random(2);
    for (const char* observer : {"a", "b"}) {
        for (int block = 0; block < 12; ++block) {
            for (int i = 0; i < 20; ++i) {
                Trial trial;
                trial.observer = observer;
                trial.radius_px = 10 * (1.5 + 0.5 * (block % 6));
                trial.stimulus = i % 2 == 0 ? Judgement::artifact : Judgement::line;
                const double p = 0.5 + 0.5 * std::exp(-std::pow(trial.radius_px / 40, 3.5));
                const bool right = random.uniform() < p;
                trial.response = right == (i % 2 == 0) ? Judgement::artifact : Judgement::line;
                trials.push_back(trial);
            }
        }
    }
    const LawFit fit = fit_law(trials, 0.75, "blocks");
    const StudyCheck check = check_study(trials, fit, {.simulations = 0});
    ASSERT_EQ(check.conditions.size(), 1u);
    ASSERT_TRUE(check.conditions.front().overdispersion.has_value());
    EXPECT_GT(*check.conditions.front().overdispersion, 0);
    EXPECT_LT(*check.conditions.front().overdispersion, 0.15) << "the answers are independent";
    EXPECT_EQ(check.conditions.front().scatter_df, 0);
    EXPECT_FALSE(check.conditions.front().scatter_p.has_value());
}

}  // namespace
}  // namespace stairstep
