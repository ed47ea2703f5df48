#include "study/engines/deviation_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "stimuli/random.h"

namespace stairstep {
namespace {

double row_sum(const DeviationKernel& kernel, size_t i) {
    double sum = 0;
    for (size_t j = 0; j < kernel.points(); ++j) sum += kernel.weight(j > i ? j - i : i - j);
    return sum / std::exp(kernel.log_row_mass(i));
}

TEST(DeviationKernel, EveryRowSharesOutOne) {
    for (const double sd : {0.0, 0.005, 0.04, 0.5, 1e9}) {
        const DeviationKernel kernel(sd, 0.01, 101);
        for (const size_t i : {0, 1, 50, 99, 100}) EXPECT_NEAR(row_sum(kernel, i), 1, 1e-13) << sd << ' ' << i;
        const std::vector<double> ones(101, 0);
        std::vector<double> out(101);
        kernel.log_given_law(ones, out);
        for (const double value : out) EXPECT_NEAR(value, 0, 1e-13);
    }
}

TEST(DeviationKernel, StepsHaveTheStandardDeviationAskedFor) {
    for (const auto& [grains, tolerance] : {std::pair{0.6, 0.013}, {0.8, 1e-4}, {4.0, 1e-9}}) {
        const DeviationKernel kernel(0.01 * grains, 0.01, 201);
        double variance = 0;
        for (size_t j = 0; j < 201; ++j) {
            const double distance = static_cast<double>(j) - 100;
            variance += kernel.weight(j > 100 ? j - 100 : 100 - j) * distance * distance;
        }
        variance /= std::exp(kernel.log_row_mass(100));
        EXPECT_NEAR(std::sqrt(variance) / grains, 1, tolerance) << grains;
    }
}

TEST(DeviationKernel, NoDeviationPassesLogarithmsOn) {
    const DeviationKernel kernel(0, 0.01, 3);
    const std::vector<double> in{-1e300, 2, -7};
    std::vector<double> out(3);
    kernel.log_given_law(in, out);
    EXPECT_EQ(out, in);
    kernel.log_given_track(in, out);
    EXPECT_EQ(out, in);
}

TEST(DeviationKernel, SumsEqualThePlainDefinitionInLongDouble) {
    Random random(3);
    // Slopes up to 100 a grid point: over the grid the terms then differ by e^10,000, beyond double and long double's own
    // e^11,000 still holds them.
    for (const double steepness : {0.1, 3.0, 100.0}) {
        for (const double sd : {0.006, 0.04, 3.0}) {
            const size_t n = 101;
            const DeviationKernel kernel(sd, 0.01, n);
            std::vector<double> in(n), law(n), track(n);
            for (size_t i = 0; i < n; ++i) {
                in[i] = -steepness * std::abs(static_cast<double>(i) - 60) + random.normal();
            }
            kernel.log_given_law(in, law);
            kernel.log_given_track(in, track);
            for (size_t i = 0; i < n; ++i) {
                long double given_law = 0, given_track = 0;
                for (size_t j = 0; j < n; ++j) {
                    const long double z = (static_cast<long double>(j) - i) * 0.01L / sd;
                    const long double w = std::exp(-z * z / 2);
                    given_law += w * std::exp(static_cast<long double>(in[j]));
                    given_track += w * std::exp(static_cast<long double>(in[j]) - kernel.log_row_mass(j));
                }
                const auto expected_law = static_cast<double>(std::log(given_law) - kernel.log_row_mass(i));
                const auto expected_track = static_cast<double>(std::log(given_track));
                EXPECT_NEAR(law[i], expected_law, 1e-12 * (1 + std::abs(expected_law))) << steepness << ' ' << sd;
                EXPECT_NEAR(track[i], expected_track, 1e-12 * (1 + std::abs(expected_track)));
            }
        }
    }
}

TEST(DeviationKernel, ReachesAsFarAsItsWeights) {
    const DeviationKernel kernel(0.04, 0.01, 501);
    const size_t reach = kernel.reach(30);
    EXPECT_GE(kernel.log_weight(reach), -30);
    EXPECT_LT(kernel.log_weight(reach + 1), -30);
    EXPECT_EQ(DeviationKernel(1e6, 0.01, 501).reach(30), 500u);
    EXPECT_EQ(DeviationKernel(0, 0.01, 501).reach(30), 0u);
}

}  // namespace
}  // namespace stairstep
