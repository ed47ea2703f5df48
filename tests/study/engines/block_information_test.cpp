#include "study/engines/block_information.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "stimuli/random.h"

namespace stairstep {
namespace {

TEST(BlockInformation, LogarithmIsWithinItsBound) {
    for (double x = 1; x > 1e-36; x *= 0.9993) {
        Lane lane;
        lane.fill(static_cast<float>(x));
        const double exact = std::log2(static_cast<double>(lane[0]));
        const Lane log = log2_of(lane);
        EXPECT_NEAR(log[0], exact, 7e-7 + 6e-8 * std::abs(exact)) << x;  // and the result is a float
        EXPECT_EQ(log[0], log[kLane - 1]);
    }
    EXPECT_EQ(log2_of(Lane{1, 1, 1, 1, 1, 1, 1, 1})[3], 0);
    // Around 1 it is small together with the logarithm.
    const float near = 1 - 1e-5f;
    EXPECT_NEAR(log2_of(Lane{near})[0] / std::log2(near), 1, 1e-5);
    EXPECT_TRUE(std::isfinite(log2_of(Lane{})[0]));
}

TEST(BlockInformation, SumsAreThoseOfTheDefinition) {
    Random random(7);
    for (const size_t nuisances : {1, 2, 5, 52}) {
        const size_t stride = kLane + 3;
        std::vector<float> weights(nuisances * kLane);
        std::vector<float> psi(nuisances * stride);
        for (float& w : weights) w = static_cast<float>(random.uniform() * 0.01);
        for (float& p : psi)
            p = random.below(5) == 0 ? static_cast<float>(random.below(2)) : static_cast<float>(random.uniform());
        for (size_t row = 0; row < nuisances; ++row) weights[row * kLane + 2] = 0;  // a threshold without weight
        Lane mass{};
        Lane inverse{};
        double right = 0;
        double given = 0;
        for (size_t k = 0; k < kLane; ++k) {
            double m = 0;
            double a = 0;
            for (size_t row = 0; row < nuisances; ++row) {
                m += weights[row * kLane + k];
                a += static_cast<double>(weights[row * kLane + k]) * psi[row * stride + k];
            }
            mass[k] = static_cast<float>(m);
            inverse[k] = m > 0 ? 1 / mass[k] : 0;
            right += a;
            const double p = m > 0 ? a / m : 0;
            if (p > 0 && p < 1) given += m * (-p * std::log2(p) - (1 - p) * std::log2(1 - p));
        }
        const BlockInformation sums = block_information(mass, inverse, weights.data(), psi.data(), stride, nuisances);
        EXPECT_NEAR(sums.right, right, 1e-6);
        EXPECT_NEAR(sums.given_bits, given, 2e-6);
    }
}

}  // namespace
}  // namespace stairstep
