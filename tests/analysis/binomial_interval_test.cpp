#include "analysis/binomial_interval.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace stairstep {
namespace {

TEST(BinomialInterval, HasTheAnchors) {
    const auto [low, high] = binomial_interval(5, 10);
    EXPECT_NEAR(low, 0.2366, 5e-5);
    EXPECT_NEAR(high, 0.7634, 5e-5);
    EXPECT_EQ(binomial_interval(0, 10).first, 0);
    EXPECT_NEAR(binomial_interval(0, 10).second, 0.2775, 5e-5);
}

/// Wilson's definition: the ends are the shares π at which the score (k/n − π)/√(π(1 − π)/n) is ±1.96.
RC_GTEST_PROP(BinomialInterval, EndsAreWhereTheScoreIsTheQuantile, ()) {
    const int n = *rc::gen::inRange(1, 2000);
    const int k = *rc::gen::inRange(0, n + 1);
    const auto [low, high] = binomial_interval(k, n);
    const double share = static_cast<double>(k) / n;
    RC_ASSERT(0 <= low && low <= share && share <= high && high <= 1);
    const auto score = [&](double p) { return (share - p) / std::sqrt(p * (1 - p) / n); };
    if (k > 0) RC_ASSERT(std::abs(score(low) - 1.959963985) < 1e-5);
    if (k < n) RC_ASSERT(std::abs(score(high) + 1.959963985) < 1e-5);
}

}  // namespace
}  // namespace stairstep
