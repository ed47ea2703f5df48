#include "analysis/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stairstep {
namespace {

TEST(MeanWithInterval, EqualsRsTTest) {
    // R: t.test(1:10) → mean 5.5, 95 percent confidence interval 3.334149 7.665851; sd(1:10) = 3.02765
    const MeanEstimate estimate = mean_with_interval({1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    EXPECT_DOUBLE_EQ(estimate.mean, 5.5);
    EXPECT_NEAR(estimate.sd, 3.02765, 5e-6);
    EXPECT_NEAR(estimate.ci95.first, 3.334149, 5e-7);
    EXPECT_NEAR(estimate.ci95.second, 7.665851, 5e-7);
}

TEST(MeanWithInterval, OfEqualValuesIsAPoint) {
    const MeanEstimate estimate = mean_with_interval({2, 2});
    EXPECT_EQ(estimate.ci95, std::pair(2.0, 2.0));
}

TEST(Statistics, QuantilesOfDistributionsAreThoseOfTables) {
    EXPECT_NEAR(t_quantile(0.975, 9), 2.262157, 5e-7);
    EXPECT_NEAR(t_quantile(0.975, 1), 12.70620, 5e-6);
    EXPECT_NEAR(t_two_sided_p(2.262157, 9), 0.05, 1e-7);
    EXPECT_NEAR(t_two_sided_p(-2.262157, 9), 0.05, 1e-7);
    EXPECT_EQ(t_two_sided_p(INFINITY, 9), 0);
    EXPECT_EQ(t_two_sided_p(0, 3), 1);
    EXPECT_NEAR(normal_quantile(0.975), 1.959964, 5e-7);
    EXPECT_NEAR(normal_cdf(-1.959964), 0.025, 1e-8);
}

TEST(Statistics, QuantilesOfValuesAreRsTypeSeven) {
    // R: quantile(1:4, .25) → 1.75; quantile(c(1, 5), .9) → 4.6
    EXPECT_DOUBLE_EQ(quantile_of_sorted(std::vector<double>{1, 2, 3, 4}, 0.25), 1.75);
    EXPECT_DOUBLE_EQ(quantile_of_sorted(std::vector<double>{1, 5}, 0.9), 4.6);
    EXPECT_EQ(quantile_of_sorted(std::vector<double>{1, 5}, 1), 5);
    EXPECT_EQ(quantile_of_sorted(std::vector<double>{7}, 0.3), 7);
    EXPECT_EQ(median({9, 1, 5}), 5);
    EXPECT_EQ(median({9, 1}), 5);
}

TEST(Holm, EqualsRsPAdjust) {
    // R: p.adjust(c(.01, .04, .03, .005), "holm") → 0.03 0.06 0.06 0.02
    const std::vector<double> adjusted = holm_adjusted({0.01, 0.04, 0.03, 0.005});
    const double expected[] = {0.03, 0.06, 0.06, 0.02};
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-15);
    EXPECT_EQ(holm_adjusted({0.6, 0.7}), (std::vector<double>{1, 1}));
    EXPECT_TRUE(holm_adjusted({}).empty());
}

}  // namespace
}  // namespace stairstep
