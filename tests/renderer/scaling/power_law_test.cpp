// Exponents against closed forms and against planted ones with noise.
#include "renderer/scaling/power_law.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "stimuli/random.h"

namespace stairstep::scaling {
namespace {

TEST(PowerLaw, HasTheHeadersAnchor) {
    const std::vector<double> x{1, 2, 4};
    const std::vector<double> y{3, 12, 48};
    const auto law = fit_power_law(x, y);
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->exponent, 2, 1e-14);
    EXPECT_NEAR(law->factor, 3, 1e-13);
    ASSERT_TRUE(law->exponent_se);
    EXPECT_NEAR(*law->exponent_se, 0, 1e-14);
}

// With ln x = −1, 0, 1 and ln y = 0, δ, 0: b = 0, residuals −δ/3, 2δ/3, −δ/3, so se = √(6δ²/9 / 1 / 2) = δ/√3.
TEST(PowerLaw, StandardErrorOfThreePoints) {
    const double delta = 0.3;
    const std::vector<double> x{std::exp(-1), 1, std::exp(1)};
    const std::vector<double> y{1, std::exp(delta), 1};
    const auto law = fit_power_law(x, y);
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->exponent, 0, 1e-14);
    EXPECT_NEAR(*law->exponent_se, delta / std::sqrt(3), 1e-14);
    EXPECT_NEAR(law->factor, std::exp(delta / 3), 1e-14);
}

TEST(PowerLaw, TwoPointsHaveNoStandardError) {
    const std::vector<double> x{10, 1000};
    const std::vector<double> y{5, 50};
    const auto law = fit_power_law(x, y);
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->exponent, 0.5, 1e-14);
    EXPECT_FALSE(law->exponent_se);
}

TEST(PowerLaw, RefusesWhatHasNoLogarithm) {
    const std::vector<double> good{1, 2, 3};
    for (const double bad : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
        const std::vector<double> values{1, bad, 3};
        EXPECT_FALSE(fit_power_law(good, values)) << bad;
        EXPECT_FALSE(fit_power_law(values, good)) << bad;
    }
    EXPECT_FALSE(fit_power_law(std::vector<double>{2, 2, 2}, good)) << "all at one place";
}

// Units of either axis leave the exponent and its error as they are.
RC_GTEST_PROP(PowerLaw, ExponentHasNoUnit, ()) {
    Random random(*rc::gen::arbitrary<uint64_t>());
    const auto count = *rc::gen::inRange<size_t>(3, 12);
    std::vector<double> x, y, scaled_x, scaled_y;
    const double unit_x = std::exp(4 * random.normal());
    const double unit_y = std::exp(4 * random.normal());
    for (size_t i = 0; i < count; ++i) {
        x.push_back(std::exp(static_cast<double>(i) + 0.3 * random.uniform()));
        y.push_back(std::exp(random.normal()));
        scaled_x.push_back(unit_x * x.back());
        scaled_y.push_back(unit_y * y.back());
    }
    const auto law = fit_power_law(x, y);
    const auto scaled = fit_power_law(scaled_x, scaled_y);
    RC_ASSERT(law && scaled);
    RC_ASSERT(std::abs(law->exponent - scaled->exponent) < 1e-9);
    RC_ASSERT(std::abs(*law->exponent_se - *scaled->exponent_se) < 1e-9);
}

// The interval b ± t·se of Student's t holds the planted exponent as often as it says: 95 %.
TEST(PowerLaw, StandardErrorCoversPlantedExponents) {
    constexpr int kFits = 4000;
    // 97.5 % quantiles of Student's t, by tables, for n − 2 degrees of freedom.
    struct Case {
        int count;
        double t_quantile;
    };
    for (const auto& [count, t_quantile] : {Case{5, 3.182446}, Case{7, 2.570582}, Case{12, 2.228139}}) {
        for (const double exponent : {-0.5, 0.0, 1.0, 2.0}) {
            Random random = Random(7).stream(static_cast<uint64_t>(count));
            int covered = 0;
            double sum = 0;
            for (int fit = 0; fit < kFits; ++fit) {
                std::vector<double> x, y;
                for (int i = 0; i < count; ++i) {
                    x.push_back(0.1 * std::pow(2, i));
                    y.push_back(40 * std::pow(x.back(), exponent) * std::exp(0.1 * random.normal()));
                }
                const auto law = fit_power_law(x, y);
                ASSERT_TRUE(law);
                covered += std::abs(law->exponent - exponent) <= t_quantile * *law->exponent_se;
                sum += law->exponent;
            }
            // Four standard deviations of a binomial share.
            EXPECT_NEAR(covered / static_cast<double>(kFits), 0.95, 4 * std::sqrt(0.95 * 0.05 / kFits))
                << count << " points, exponent " << exponent;
            EXPECT_NEAR(sum / kFits, exponent, 0.005) << "unbiased";
        }
    }
}

}  // namespace
}  // namespace stairstep::scaling
