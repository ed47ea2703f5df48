#include "analysis/threshold_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/random.h"
#include "study/psychometric.h"

namespace stairstep {
namespace {

/// Strengths that never repeat, a million equal trials, and two that are far away.
std::vector<PooledTrials> mixed_trials() {
    Random random(4);
    std::vector<PooledTrials> trials;
    for (int i = 0; i < 300; ++i) trials.push_back({0.25 * random.normal(), random.uniform() < 0.75, 1});
    trials = pool(trials);
    trials.push_back({0.5, true, 1000000});
    trials.push_back({0.6, false, 7});
    trials.push_back({-500, true, 1});
    trials.push_back({500, false, 1});
    return trials;
}

TEST(ThresholdLikelihood, IsThatOfThePsychometricFunction) {
    const auto track = mixed_trials();
    const LocationGrid grid{-1.5, 1.5, 100};
    for (const double beta : {0.8, 3.0, 12.0}) {
        for (const double delta : {1e-7, 1e-6, 0.02, 0.3}) {
            const PsychometricShape shape{beta, kGuessRate, delta, 0.82};
            const std::vector<double> table = location_log_likelihood(track, beta, delta, grid);
            for (size_t i = 0; i < table.size(); ++i) {
                double sum = 0;
                for (const PooledTrials& t : track) {
                    sum += t.count * log_likelihood(shape, 0, t.strength, grid.at(i), t.correct);
                }
                ASSERT_NEAR(table[i], sum, 1e-9 + 1e-12 * std::abs(sum)) << beta << " " << delta << " " << grid.at(i);
            }
        }
    }
}

TEST(ThresholdLikelihood, HasARowForEachLapseRateAndSkipsByStride) {
    const auto track = mixed_trials();
    std::vector<PooledTrials> every_third;
    for (size_t k = 0; k < track.size(); k += 3) every_third.push_back(track[k]);
    const LocationGrid grid{-1, 1, 50};
    std::vector<double> rows(2 * grid.points);
    add_log_likelihood(rows, track, 3, grid, 3, {0.01, 0.06});
    const std::vector<double> first = location_log_likelihood(every_third, 3, 0.01, grid);
    const std::vector<double> second = location_log_likelihood(every_third, 3, 0.06, grid);
    for (size_t i = 0; i < grid.points; ++i) {
        EXPECT_NEAR(rows[i], first[i], 1e-9);
        EXPECT_NEAR(rows[grid.points + i], second[i], 1e-9);
    }
}

TEST(ThresholdLikelihood, WithoutOverdispersionAnswersAreIndependent) {
    std::vector<PooledTrials> blocks;
    for (int k = 0; k < 7; ++k) {
        blocks.push_back({0.1 * k, false, 7.0 - k});
        blocks.push_back({0.1 * k, true, 5.0 + k});
    }
    const LocationGrid grid{-0.5, 0.5, 20};
    std::vector<double> together(grid.points);
    add_overdispersed_log_likelihood(together, pool(blocks), 1, grid, 3, {0.02}, 0);
    const std::vector<double> alone = location_log_likelihood(pool(blocks), 3, 0.02, grid);
    for (size_t i = 0; i < grid.points; ++i) EXPECT_NEAR(together[i], alone[i], 1e-9);
}

}  // namespace
}  // namespace stairstep
