// What must hold for every engine, adaptive or not.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "stimuli/random.h"
#include "study/engines/constant_stimuli.h"
#include "study/engines/psi_marginal.h"
#include "study/engines/quest.h"
#include "study/engines/staircase.h"

namespace stairstep {
namespace {

struct QuestVariant {
    static Quest make() { return Quest({}); }
};
struct MinimumEntropyVariant {
    static PsiMarginal make() { return PsiMarginal(minimum_entropy_settings({})); }
};
struct PsiMarginalVariant {
    static PsiMarginal make() {
        PsiMarginalSettings s;
        s.grain = 0.04;
        s.beta_count = 5;
        s.delta_count = 3;
        return PsiMarginal(s);
    }
};
struct YesNoVariant {
    static PsiMarginal make() {
        PsiMarginalSettings s;
        s.grain = 0.04;
        s.beta_count = 3;
        s.delta_count = 2;
        s.gamma_low = 0;
        s.gamma_count = 3;
        s.learn_slope = true;
        return PsiMarginal(s);
    }
};
struct TransformedVariant {
    static Staircase make() { return Staircase({.down_after = 3}); }
};
struct WeightedVariant {
    static Staircase make() {
        return Staircase({.down_after = 1, .up_over_down = weighted_up_over_down(0.82), .steps = {0.1, 0.05, 0.02}});
    }
};
struct ConstantStimuliVariant {
    static ConstantStimuli make() { return ConstantStimuli({}); }
};

template <typename Variant>
class Engines : public testing::Test {};
using Variants = testing::Types<QuestVariant, MinimumEntropyVariant, PsiMarginalVariant, YesNoVariant,
                                TransformedVariant, WeightedVariant, ConstantStimuliVariant>;
TYPED_TEST_SUITE(Engines, Variants);

/// Everything an engine says, to the last bit.
template <AdaptiveEngine E>
auto state(const E& engine) {
    const ThresholdEstimate e = engine.estimate();
    const auto bits = [](double value) { return std::bit_cast<uint64_t>(value); };
    return std::tuple(engine.trials(), bits(engine.suggest()), bits(e.threshold), bits(e.sd), bits(e.low),
                      bits(e.high));
}

template <AdaptiveEngine E>
void expect_sound(const E& engine) {
    const ThresholdEstimate e = engine.estimate();
    EXPECT_TRUE(std::isfinite(engine.suggest()));
    EXPECT_TRUE(std::isfinite(e.threshold));
    EXPECT_TRUE(std::isfinite(e.sd) && e.sd >= 0);
    EXPECT_TRUE(std::isfinite(e.low) && std::isfinite(e.high));
    EXPECT_LE(e.low, e.high);
}

/// Answers of an observer with this threshold at the intensities suggested.
template <AdaptiveEngine E>
void observe(E& engine, double threshold, int trials, uint64_t seed) {
    Random random(seed);
    const PsychometricShape shape;
    for (int trial = 0; trial < trials; ++trial) {
        const double x = engine.suggest();
        engine.update(x, random.uniform() < probability_correct(shape, threshold_offset(shape), x, threshold));
    }
}

TYPED_TEST(Engines, FindAPlantedThreshold) {
    for (const double planted : {-0.2, 0.13}) {
        for (const uint64_t seed : {1, 2, 3}) {
            auto engine = TypeParam::make();
            expect_sound(engine);
            observe(engine, planted, 200, seed);
            expect_sound(engine);
            EXPECT_EQ(engine.trials(), 200);
            const ThresholdEstimate estimate = engine.estimate();
            EXPECT_NEAR(estimate.threshold, planted, 4 * estimate.sd);
            EXPECT_LT(estimate.sd, 0.15);
            EXPECT_LT(estimate.high - estimate.low, 0.3);
        }
    }
}

TYPED_TEST(Engines, StayFiniteUnderContradictions) {
    auto engine = TypeParam::make();
    for (int i = 0; i < 1500; ++i) engine.update(i % 2 == 0 ? 8 : -8, i % 2 != 0);
    expect_sound(engine);
    for (int i = 0; i < 200; ++i) engine.update(engine.suggest(), i % 2 != 0);
    expect_sound(engine);
    for (const bool answer : {false, true}) {
        auto steady = TypeParam::make();
        for (int i = 0; i < 400; ++i) steady.update(steady.suggest(), answer);
        expect_sound(steady);
    }
}

TYPED_TEST(Engines, TakeAnyIntensityForWhatItIs) {
    auto engine = TypeParam::make();
    for (const double x : {0.012345678, -0.33333333, 40.0, -40.0, 1e6, -1e6, 1e300, -1e300}) {
        engine.update(x, x > 0);
        expect_sound(engine);
    }
    // A hit at the far end tells nothing; one in the middle lowers the threshold more than one a little above.
    auto far = TypeParam::make(), above = TypeParam::make(), middle = TypeParam::make();
    const double before = far.estimate().threshold;
    far.update(40, true);
    above.update(0.2034, true);
    middle.update(0.0034, true);
    EXPECT_NEAR(far.estimate().threshold, before, 1e-6);
    EXPECT_LT(above.estimate().threshold, before);
    EXPECT_LT(middle.estimate().threshold, above.estimate().threshold);
}

TYPED_TEST(Engines, AreValues) {
    auto original = TypeParam::make();
    observe(original, 0.1, 25, 4);
    auto copy = original;
    const auto before = state(original);
    EXPECT_EQ(state(copy), before);
    observe(copy, -0.4, 10, 5);
    EXPECT_EQ(state(original), before);
    EXPECT_NE(state(copy), before);
    copy = original;
    EXPECT_EQ(state(copy), before);
}

TYPED_TEST(Engines, GiveTheSameBitsForTheSameTrials) {
    auto first = TypeParam::make(), second = TypeParam::make();
    Random random(6);
    for (int i = 0; i < 150; ++i) {
        const double x = first.suggest() + 0.05 * random.normal();
        const bool correct = random.uniform() < 0.8;
        first.update(x, correct);
        // Asking changes nothing.
        if (i % 10 == 0) state(second);
        second.update(x, correct);
    }
    EXPECT_EQ(state(first), state(second));
}

}  // namespace
}  // namespace stairstep
