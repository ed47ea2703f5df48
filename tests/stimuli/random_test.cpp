#include "stimuli/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

namespace stairstep {
namespace {

TEST(Random, GivesThePublishedSequence) {
    // xoshiro256++ seeded with 0 through SplitMix64: the first values that the Rust crate `rand` tests against.
    Random random(0);
    for (const uint64_t expected : {5987356902031041503u, 7051070477665621255u, 6633766593972829180u,
                                    211316841551650330u, 9136120204379184874u}) {
        EXPECT_EQ(random.bits(), expected);
    }
}

TEST(Random, NormalHasMomentsOfANormal) {
    Random random(5);
    constexpr int kCount = 400000;
    double sum = 0, squares = 0, fourth = 0;
    for (int i = 0; i < kCount; ++i) {
        const double z = random.normal();
        sum += z;
        squares += z * z;
        fourth += z * z * z * z;
    }
    EXPECT_NEAR(sum / kCount, 0, 5 / std::sqrt(kCount));
    EXPECT_NEAR(squares / kCount, 1, 5 * std::sqrt(2.0 / kCount));
    EXPECT_NEAR(fourth / kCount, 3, 5 * std::sqrt(96.0 / kCount));
}

TEST(Random, BelowIsUniform) {
    Random random(6);
    std::array<int, 7> counts{};
    constexpr int kCount = 70000;
    for (int i = 0; i < kCount; ++i) ++counts[random.below(7)];
    double chi_squared = 0;
    for (const int count : counts) chi_squared += (count - 10000.0) * (count - 10000.0) / 10000;
    EXPECT_LT(chi_squared, 22.5);  // χ²₆ at 0.999
}

TEST(Random, StreamsAreTheirOwn) {
    const Random root(9);
    EXPECT_EQ(root.stream(3).bits(), root.stream(3).bits());
    EXPECT_NE(root.stream(3).bits(), root.stream(4).bits());
    EXPECT_NE(root.stream(0).bits(), Random(9).bits());
}

}  // namespace
}  // namespace stairstep
