#include "analysis/statistics.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace stairstep
