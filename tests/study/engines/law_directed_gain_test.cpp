#include "study/engines/law_directed_gain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stimuli/error.h"
#include "study/engines/quest.h"

namespace stairstep {
namespace {

/// A coarse grid, so that a test takes a second.
GainSettings quick(std::vector<PsychometricShape> shapes, int runs) {
    GainSettings settings;
    settings.engine.grain = 0.05;
    settings.engine.shapes = std::move(shapes);
    settings.checkpoints = {40, 80};
    settings.runs = runs;
    return settings;
}

const GainRow& row(const GainTable& table, GainMethod method, int trials) {
    return *std::find_if(table.rows.begin(), table.rows.end(),
                         [&](const GainRow& r) { return r.method == method && r.trials == trials; });
}

const GainRatio& ratio(const GainTable& table, GainMethod method, int trials) {
    return *std::find_if(table.ratios.begin(), table.ratios.end(),
                         [&](const GainRatio& r) { return r.method == method && r.trials == trials; });
}

TEST(LawDirectedGain, FewerTrialsThanIndependentTracksHoweverPooled) {
    // Without lapses: a lapse early on makes an error so large that a few decide over the mean of hundreds of runs.
    GainSettings settings = quick({PsychometricShape{.delta = 0}}, 200);
    settings.observer.delta = 0;
    const GainTable table = simulate_gain(settings);
    for (const int trials : {40, 80}) {
        const GainRow& directed = row(table, GainMethod::law_directed, trials);
        for (const GainMethod other :
             {GainMethod::quest_hierarchical, GainMethod::quest_weighted, GainMethod::quest_mean}) {
            const GainRow& compared = row(table, other, trials);
            EXPECT_LT(directed.rmse + 2 * std::hypot(directed.rmse_se, compared.rmse_se), compared.rmse)
                << to_string(other) << ' ' << trials;
        }
        // No method beats what the tracks' own deviations and the information in that many trials leave.
        const double information = largest_information(settings.observer);
        EXPECT_GT(directed.rmse, 0.9 * std::sqrt(0.04 * 0.04 / 4 + 1 / (trials * information)));
        EXPECT_GT(directed.coverage, 0.9);
    }
    const GainRatio& needed = ratio(table, GainMethod::quest_hierarchical, 40);
    ASSERT_TRUE(needed.ratio);
    EXPECT_GT(*needed.ratio, 1.2);
}

TEST(LawDirectedGain, OneFixedSlopeMisleadsWhereSeveralDoNot) {
    const auto simulated = [](std::vector<PsychometricShape> shapes, int runs) {
        GainSettings settings = quick(std::move(shapes), runs);
        settings.observer.beta = 2;
        settings.checkpoints = {160};
        return row(simulate_gain(settings), GainMethod::law_directed, 160);
    };
    const GainRow fixed = simulated({PsychometricShape{}}, 200);
    const GainRow several = simulated(usual_shapes(), 40);
    EXPECT_LT(fixed.coverage, 0.8);
    EXPECT_GT(several.coverage, 0.82);
}

TEST(LawDirectedGain, RatioIsWhereTheErrorsMeet) {
    GainSettings settings = quick({PsychometricShape{.delta = 0}}, 100);
    settings.observer.delta = 0;
    const GainTable table = simulate_gain(settings);
    const GainRatio& found = ratio(table, GainMethod::quest_hierarchical, 40);
    ASSERT_TRUE(found.ratio);
    const double needed = *found.ratio * 40;
    settings.checkpoints = {40, static_cast<int>(std::floor(needed)), static_cast<int>(std::ceil(needed)), 80};
    const GainTable at = simulate_gain(settings);
    const double goal = row(at, GainMethod::law_directed, 40).rmse;
    EXPECT_EQ(goal, row(table, GainMethod::law_directed, 40).rmse);
    EXPECT_GT(row(at, GainMethod::quest_hierarchical, settings.checkpoints[1]).rmse, goal);
    EXPECT_LE(row(at, GainMethod::quest_hierarchical, settings.checkpoints[2]).rmse, goal);
}

TEST(LawDirectedGain, DoesNotDependOnThreads) {
    GainSettings settings = quick({PsychometricShape{}}, 20);
    settings.jobs = 1;
    const GainTable one = simulate_gain(settings);
    settings.jobs = 3;
    const GainTable three = simulate_gain(settings);
    ASSERT_EQ(one.rows.size(), 2u * kGainMethods);
    for (size_t i = 0; i < one.rows.size(); ++i) {
        EXPECT_EQ(one.rows[i].rmse, three.rows[i].rmse);
        EXPECT_EQ(one.rows[i].coverage, three.rows[i].coverage);
    }
}

TEST(LawDirectedGain, RefusesImpossibleSettings) {
    GainSettings settings;
    settings.runs = 19;
    EXPECT_THROW(simulate_gain(settings), InputError);
    settings = {};
    settings.checkpoints = {40, 20};
    EXPECT_THROW(simulate_gain(settings), InputError);
    settings.checkpoints = {};
    EXPECT_THROW(simulate_gain(settings), InputError);
    settings = {};
    settings.true_deviation_sd = -1;
    EXPECT_THROW(simulate_gain(settings), InputError);
    settings = {};
    settings.observer.beta = 0;
    EXPECT_THROW(simulate_gain(settings), InputError);
}

}  // namespace
}  // namespace stairstep
