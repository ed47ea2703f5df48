#include "study/psychometric.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stairstep {
namespace {

TEST(Psychometric, OffsetEqualsHarveys) {
    // Harvey (1986): ε = .0571 for β 3.5, γ 0, δ 0, p_T .795.
    const double offset = threshold_offset({.beta = 3.5, .gamma = 0, .delta = 0, .p_threshold = 0.795});
    EXPECT_NEAR(offset, 0.0571, 5e-5);
}

RC_GTEST_PROP(Psychometric, IsAtItsThresholdProbabilityExactlyAtThreshold, ()) {
    const auto unit = [](int steps) { return *rc::gen::inRange(0, steps + 1) / static_cast<double>(steps); };
    PsychometricShape shape;
    shape.beta = 0.1 + 20 * unit(1000);
    shape.gamma = 0.6 * unit(1000);
    shape.delta = 0.1 * unit(1000);
    const double top = 1 - shape.delta * (1 - shape.gamma);
    shape.p_threshold = shape.gamma + (top - shape.gamma) * (0.01 + 0.98 * unit(1000));
    RC_PRE(is_valid(shape));
    const double threshold = 4 * unit(1000) - 2;
    const double p = probability_correct(shape, threshold_offset(shape), threshold, threshold);
    RC_ASSERT(std::abs(p - shape.p_threshold) < 1e-12);
}

TEST(Psychometric, RisesFromGuessingToAllButLapsesAndStaysFinite) {
    const PsychometricShape shape;
    const double offset = threshold_offset(shape);
    double below = 0;
    for (double x = -400; x <= 400; x += 0.25) {
        const double p = probability_correct(shape, offset, x, 0);
        EXPECT_GE(p, below);
        below = p;
    }
    EXPECT_DOUBLE_EQ(probability_correct(shape, offset, -1e6, 0), 0.5);
    EXPECT_DOUBLE_EQ(probability_correct(shape, offset, 1e6, 0), 0.995);
}

TEST(Psychometric, LogLikelihoodIsTheLogarithmAndStaysFiniteWhereItUnderflows) {
    for (const double x : {-1.0, -0.2, 0.0, 0.1, 0.3}) {
        for (const double delta : {0.0, 0.01}) {
            const PsychometricShape shape{.delta = delta};
            const double offset = threshold_offset(shape);
            const double p = probability_correct(shape, offset, x, 0);
            EXPECT_NEAR(log_likelihood(shape, offset, x, 0, true), std::log(p), 1e-12);
            EXPECT_NEAR(log_likelihood(shape, offset, x, 0, false), std::log(1 - p), 4e-16 / (1 - p));  // 1 − p rounds
        }
    }
    const PsychometricShape certain{.gamma = 0, .delta = 0, .p_threshold = 0.5};
    for (const double x : {-1e6, -50.0, 50.0, 1e6}) {
        EXPECT_TRUE(std::isfinite(log_likelihood(certain, threshold_offset(certain), x, 0, true))) << x;
        EXPECT_TRUE(std::isfinite(log_likelihood(certain, threshold_offset(certain), x, 0, false))) << x;
    }
}

TEST(Psychometric, KnowsImpossibleShapes) {
    EXPECT_TRUE(is_valid({}));
    EXPECT_FALSE(is_valid({.beta = 0}));
    EXPECT_FALSE(is_valid({.gamma = 1}));
    EXPECT_FALSE(is_valid({.delta = -0.1}));
    EXPECT_FALSE(is_valid({.p_threshold = 0.5}));
    EXPECT_FALSE(is_valid({.delta = 0.5, .p_threshold = 0.82}));
    EXPECT_FALSE(is_valid({.beta = NAN}));
}

}  // namespace
}  // namespace stairstep
