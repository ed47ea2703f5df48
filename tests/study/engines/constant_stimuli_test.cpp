#include "study/engines/constant_stimuli.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "stimuli/error.h"

namespace stairstep {
namespace {

std::vector<double> suggestions(ConstantStimuli engine, int trials) {
    std::vector<double> shown;
    for (int trial = 0; trial < trials; ++trial) {
        shown.push_back(engine.suggest());
        engine.update(shown.back(), trial % 3 != 0);
    }
    return shown;
}

TEST(ConstantStimuli, ShowsEveryLevelOnceInEachBlock) {
    const ConstantStimuliSettings settings{.levels = {-1, 0, 0.5, 2}, .repetitions = 30, .posterior = {.guess = 0.25}};
    const ConstantStimuli engine(settings);
    EXPECT_EQ(engine.planned_trials(), 120);
    const std::vector<double> shown = suggestions(engine, engine.planned_trials() + 4);
    std::set<std::vector<double>> orders;
    for (size_t block = 0; block < shown.size(); block += 4) {
        std::vector<double> levels(shown.begin() + static_cast<long>(block),
                                   shown.begin() + static_cast<long>(block) + 4);
        orders.insert(levels);
        std::sort(levels.begin(), levels.end());
        EXPECT_EQ(levels, (std::vector<double>{-0.75, 0.25, 0.75, 2.25})) << block;
    }
    EXPECT_GT(orders.size(), 10u);  // of 24 possible ones, in 31 blocks
}

TEST(ConstantStimuli, OrderFollowsFromTheSeedAlone) {
    const auto order = [](uint64_t seed) { return suggestions(ConstantStimuli({.seed = seed}), 70); };
    EXPECT_EQ(order(5), order(5));
    EXPECT_NE(order(5), order(6));
}

TEST(ConstantStimuli, EstimatesByThePosteriorOfAllTrials) {
    ConstantStimuli engine({});
    Quest quest({});
    for (int trial = 0; trial < 70; ++trial) {
        const double x = engine.suggest();
        engine.update(x, x > 0.1);
        quest.update(x, x > 0.1);
    }
    EXPECT_DOUBLE_EQ(engine.estimate().threshold, quest.mean());
    EXPECT_DOUBLE_EQ(engine.estimate().sd, quest.sd());
    EXPECT_EQ(engine.trials(), 70);
}

TEST(ConstantStimuli, RefusesImpossibleSettings) {
    EXPECT_THROW(ConstantStimuli({.levels = {}}), InputError);
    EXPECT_THROW(ConstantStimuli({.levels = {0, NAN}}), InputError);
    EXPECT_THROW(ConstantStimuli({.repetitions = 0}), InputError);
    EXPECT_THROW(ConstantStimuli({.posterior = {.guess_sd = -1}}), InputError);
}

}  // namespace
}  // namespace stairstep
