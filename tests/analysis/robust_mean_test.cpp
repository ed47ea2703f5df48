#include "analysis/robust_mean.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stimuli/random.h"

namespace stairstep {
namespace {

TEST(HuberMean, IsThePlainMeanWhereNobodyIsFarOff) {
    // 1 to 6: MAD 1.5, so that the farthest is 2.5/(1.4826·1.5) = 1.12 off.
    const std::vector<Effect> effects{{1, 0.1}, {2, 0.1}, {3, 0.1}, {4, 0.1}, {5, 0.1}, {6, 0.1}};
    const RobustMean robust = huber_mean(effects);
    const RandomEffects plain = fit_random_effects(effects);
    EXPECT_EQ(robust.weight, std::vector<double>(6, 1.0));
    EXPECT_NEAR(robust.tau, std::sqrt(1.4826 * 1.4826 * 2.25 - 0.01), 1e-12);
    EXPECT_NEAR(robust.mean, plain.mean, 1e-12);
    EXPECT_NEAR(robust.se, plain.se, 1e-12);
}

TEST(HuberMean, BoundsWhatOneWildObserverDoesAndNamesThem) {
    std::vector<Effect> effects;
    for (const double v : {0.9, 1.0, 1.1, 1.05, 0.95, 1.02, 0.97, 1.08, 0.93}) effects.push_back({v, 0.05});
    const double without = huber_mean(effects).mean;
    effects.push_back({3, 0.05});
    const RobustMean near = huber_mean(effects);
    effects.back().value = 300;
    const RobustMean far = huber_mean(effects);
    EXPECT_NEAR(near.mean, without, 0.03);
    EXPECT_NEAR(far.mean, near.mean, 1e-9);  // ψ is bounded: how far doesn't matter
    EXPECT_GT(fit_random_effects(effects).mean, 10);
    for (size_t j = 0; j < 9; ++j) EXPECT_GT(far.weight[j], 0.7);
    const double sigma = std::sqrt(far.tau * far.tau + 0.05 * 0.05);
    EXPECT_NEAR(far.weight[9], kHuberBound * sigma / (300 - far.mean), 1e-9);
}

TEST(HuberMean, SolvesItsEquation) {
    Random random(2);
    std::vector<Effect> effects;
    for (int j = 0; j < 12; ++j) effects.push_back({random.normal() * (j < 3 ? 4 : 1), 0.2 + random.uniform()});
    const RobustMean fit = huber_mean(effects);
    double sum = 0;
    for (const Effect& e : effects) {
        const double sigma = std::sqrt(fit.tau * fit.tau + e.se * e.se);
        sum += std::clamp((e.value - fit.mean) / sigma, -kHuberBound, kHuberBound) / sigma;
    }
    EXPECT_NEAR(sum, 0, 1e-9);
}

TEST(HuberMean, CoversForNormalObserversAndAfterOneWildOne) {
    int covered = 0;
    int covered_wild = 0;
    constexpr int kStudies = 3000;
    for (int i = 0; i < kStudies; ++i) {
        Random random = Random(6).stream(static_cast<uint64_t>(i));
        std::vector<Effect> effects;
        for (int j = 0; j < 10; ++j) effects.push_back({0.17 * random.normal(), 0.06});
        const RobustMean fit = huber_mean(effects);
        covered += fit.ci95.first <= 0 && 0 <= fit.ci95.second;
        effects.back().value = 1.5;
        const RobustMean wild = huber_mean(effects);
        covered_wild += wild.ci95.first <= 0 && 0 <= wild.ci95.second;
    }
    std::printf("Huber mean of 10: %.3f; with one wild: %.3f\n", covered / double(kStudies),
                covered_wild / double(kStudies));
    EXPECT_GE(covered, 0.92 * kStudies);
    EXPECT_LE(covered, 0.98 * kStudies);
    EXPECT_GE(covered_wild, 0.89 * kStudies);  // a one-sided outlier pulls by up to k/n
}

TEST(HuberMean, IsThePlainOneWhereItCannotTell) {
    const std::vector<Effect> three{{1, 0.1}, {2, 0.1}, {30, 0.1}};
    EXPECT_EQ(huber_mean(three).mean, fit_random_effects(three).mean);
    const std::vector<Effect> mostly_equal{{1, 0}, {1, 0}, {1, 0}, {1, 0}, {2, 0}};
    EXPECT_TRUE(std::isfinite(huber_mean(mostly_equal).mean));
    EXPECT_EQ(huber_mean(std::vector<Effect>(6, Effect{2, 0.1})).ci95, std::pair(2.0, 2.0));
}

}  // namespace
}  // namespace stairstep
