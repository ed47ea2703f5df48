#include "analysis/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stimuli/random.h"

namespace stairstep {
namespace {

ConditionLaw condition(Pattern pattern, double contrast, const std::vector<double>& ln_slopes, int first = 0) {
    ConditionLaw law;
    law.pattern = pattern;
    law.contrast = contrast;
    for (size_t j = 0; j < ln_slopes.size(); ++j) {
        law.observer_slopes.push_back({"o" + std::to_string(first + static_cast<int>(j)), ln_slopes[j], 0.1, 0, 0, 0});
    }
    return law;
}

TEST(PairedComparisons, EqualRsPairedTTest) {
    // R: t.test(c(1.2,1.4,1.1,1.5) − c(1.0,1.1,1.05,1.15)): mean .225, t = 3.395499, p = .04259, interval [.0141, .4359].
    std::vector<std::string> warnings;
    const auto all = paired_comparisons(
        {condition(Pattern::step, 1, {1.2, 1.4, 1.1, 1.5}), condition(Pattern::stair, 1, {1.0, 1.1, 1.05, 1.15})},
        warnings);
    ASSERT_EQ(all.size(), 1u);
    const double d[] = {0.2, 0.3, 0.05, 0.35};
    double squares = 0;
    for (const double x : d) squares += (x - 0.225) * (x - 0.225);
    const double se = std::sqrt(squares / 3 / 4);
    EXPECT_NEAR(all[0].ratio, std::exp(0.225), 1e-12);
    EXPECT_NEAR(all[0].ratio_ci95.first, std::exp(0.225 - 3.182446 * se), 1e-6);
    EXPECT_NEAR(all[0].ratio_ci95.second, std::exp(0.225 + 3.182446 * se), 1e-6);
    // Three degrees of freedom have a closed form: P(|T| > t) = 1 − (2/π)[θ + sin θ cos θ], tan θ = t/√3.
    const double theta = std::atan(0.225 / se / std::sqrt(3.0));
    EXPECT_NEAR(all[0].p, 1 - 2 / std::numbers::pi * (theta + std::sin(theta) * std::cos(theta)), 1e-9);
    EXPECT_EQ(all[0].p_holm, all[0].p);
    EXPECT_EQ(all[0].observers, 4);
}

TEST(PairedComparisons, CoverTheWholeFamilyAndUseOnlyCommonObservers) {
    std::vector<std::string> warnings;
    const auto all = paired_comparisons(
        {condition(Pattern::step, 1, {1.2, 1.4, 1.1, 1.5, 1.3}),
         condition(Pattern::step, 0.5, {1.1, 1.35, 1.1, 1.4}, 1), condition(Pattern::stair, 1, {0.9, 1.0, 0.8, 1.2}),
         condition(Pattern::stair, 0.5, {0.85, 1.0}, 8)},
        warnings);
    ASSERT_EQ(all.size(), 2u);  // step 100/50 % and step/stair at 100 %
    EXPECT_EQ(all[0].observers, 4);
    EXPECT_EQ(all[1].observers, 4);
    EXPECT_EQ(warnings.size(), 2u);  // the last condition shares nobody
    for (const Comparison& c : all) EXPECT_GE(c.p_holm, c.p);
}

TEST(PairedComparisons, RejectATrueNullAsOftenAsTheySay) {
    // Four equal conditions of ten observers who differ much more than their conditions do: any p_holm < .05 in at most 5 %.
    int any = 0;
    constexpr int kStudies = 1500;
    for (int i = 0; i < kStudies; ++i) {
        Random random = Random(31).stream(static_cast<uint64_t>(i));
        std::vector<ConditionLaw> conditions;
        std::vector<double> common(10);
        for (double& c : common) c = random.normal();
        for (const Pattern pattern : {Pattern::step, Pattern::stair}) {
            for (const double contrast : {1.0, 0.5}) {
                std::vector<double> slopes;
                for (const double c : common) slopes.push_back(c + 0.1 * random.normal());
                conditions.push_back(condition(pattern, contrast, slopes));
            }
        }
        std::vector<std::string> warnings;
        const auto all = paired_comparisons(conditions, warnings);
        ASSERT_EQ(all.size(), 4u);
        any += std::any_of(all.begin(), all.end(), [](const Comparison& c) { return c.p_holm < 0.05; });
    }
    EXPECT_LE(any, 0.05 * kStudies + 3 * std::sqrt(0.05 * 0.95 * kStudies));
    EXPECT_GE(any, 0.02 * kStudies);
}

TEST(PairedComparisons, HoldWithoutAnySpread) {
    std::vector<std::string> warnings;
    const auto equal =
        paired_comparisons({condition(Pattern::step, 1, {1, 1, 1}), condition(Pattern::stair, 1, {1, 1, 1})}, warnings);
    EXPECT_EQ(equal[0].p, 1);
    EXPECT_EQ(equal[0].ratio, 1);
    const auto apart =
        paired_comparisons({condition(Pattern::step, 1, {2, 2, 2}), condition(Pattern::stair, 1, {1, 1, 1})}, warnings);
    EXPECT_EQ(apart[0].p, 0);
}

}  // namespace
}  // namespace stairstep
