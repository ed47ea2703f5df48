#include "study/engines/quest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

TEST(Quest, KnowsTheInformationOfATrial) {
    // references: I* = 17.789 at Ψ = .908 for β 3.5, γ .5, δ .01; the offset to there is .0638.
    const PsychometricShape shape;
    EXPECT_NEAR(largest_information(shape), 17.789, 5e-4);
    EXPECT_NEAR(most_informative_offset(shape), 0.0638, 5e-5);
    EXPECT_NEAR(probability_correct(shape, threshold_offset(shape), most_informative_offset(shape), 0), 0.908, 5e-4);
}

/// SD of the estimate after `trials` trials, for true thresholds drawn from the prior.
double simulated_sd(int trials, int runs) {
    const PsychometricShape shape;
    const double offset = threshold_offset(shape);
    double squares = 0;
    for (int run = 0; run < runs; ++run) {
        Random random = Random(11).stream(static_cast<uint64_t>(run));
        const double threshold = 0.5 * random.normal();
        Quest quest({});
        for (int trial = 0; trial < trials; ++trial) {
            const double x = quest.suggest();
            quest.update(x, random.uniform() < probability_correct(shape, offset, x, threshold));
        }
        squares += (quest.mean() - threshold) * (quest.mean() - threshold);
    }
    return std::sqrt(squares / runs);
}

TEST(Quest, IsAsEfficientAsPlacementAtTheMeanCanBe) {
    // references, 2,000 runs of another implementation: .0555 after 40 trials, .0397 after 60; bound .0374 and .0306.
    // The SD of an SD over 2,000 runs is 1.6 %.
    const double after_40 = simulated_sd(40, 2000);
    EXPECT_LT(after_40, 0.0555 * 1.06);
    EXPECT_GT(after_40, 0.0374);
    EXPECT_LT(simulated_sd(60, 1000), 0.0397 * 1.08);
}

TEST(Quest, PosteriorEqualsThePlainProductOfLikelihoods) {
    const QuestSettings settings{.guess = -0.4};
    Quest quest(settings);
    const std::vector<std::pair<double, bool>> answers{
        {-0.3, true}, {-0.512345, false}, {0.2, true}, {-2.0, false}, {3.7, true}};
    for (const auto& [x, correct] : answers) quest.update(x, correct);

    const double offset = threshold_offset(settings.shape);
    double mass = 0, first = 0, second = 0;
    for (int i = -250; i <= 250; ++i) {
        const double t = settings.guess + i * 0.01;
        double p = std::exp(-(t - settings.guess) * (t - settings.guess) / (2 * 0.5 * 0.5));
        for (const auto& [x, correct] : answers) {
            const double likelihood = probability_correct(settings.shape, offset, x, t);
            p *= correct ? likelihood : 1 - likelihood;
        }
        mass += p;
        first += p * t;
        second += p * t * t;
    }
    EXPECT_NEAR(quest.mean(), first / mass, 1e-12);
    EXPECT_NEAR(quest.sd(), std::sqrt(second / mass - first * first / mass / mass), 1e-12);
}

TEST(Quest, DistinguishesIntensitiesBeyondItsRange) {
    Quest near({}), far({});
    near.update(1.9, true);
    far.update(5, true);
    EXPECT_LT(near.mean(), far.mean());  // a hit at 5 says nothing, one at 1.9 rules out thresholds above
}

TEST(Quest, StaysFiniteUnderContradictionsAndExtremes) {
    for (const double beta : {0.1, 3.5, 50.0}) {
        for (const double prior_sd : {1e-6, 0.5, 1e6}) {
            QuestSettings settings{.guess_sd = prior_sd};
            settings.shape = {.beta = beta, .gamma = 0, .delta = 0, .p_threshold = 0.5};
            Quest quest(settings);
            for (int i = 0; i < 3000; ++i) quest.update(i % 2 == 0 ? 10 : -10, i % 2 != 0);
            EXPECT_TRUE(std::isfinite(quest.mean())) << beta << ' ' << prior_sd;
            EXPECT_TRUE(std::isfinite(quest.suggest()));
            EXPECT_GE(quest.sd(), 0);
        }
    }
}

TEST(Quest, RefusesImpossibleSettings) {
    EXPECT_THROW(Quest({.guess = NAN}), InputError);
    EXPECT_THROW(Quest({.guess_sd = 0}), InputError);
    EXPECT_THROW(Quest({.grain = 0}), InputError);
    EXPECT_THROW(Quest({.grain = 1e-9}), InputError);
    QuestSettings settings;
    settings.shape.beta = -1;
    EXPECT_THROW(Quest{settings}, InputError);
}

}  // namespace
}  // namespace stairstep
