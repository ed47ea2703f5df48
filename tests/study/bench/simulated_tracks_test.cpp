#include "study/bench/simulated_tracks.h"

#include <gtest/gtest.h>

#include "study/engines/quest.h"

namespace stairstep {
namespace {

/// Learns nothing: its errors are the thresholds themselves.
class Stubborn {
  public:
    explicit Stubborn(double intensity) : intensity_(intensity) {}
    double suggest() const { return intensity_; }
    void update(double, bool) { ++trials_; }
    /// That T is 0, and 95 % of the posterior within 1 of it.
    ThresholdEstimate estimate() const { return {0, 1, -1, 1}; }
    int trials() const { return trials_; }

  private:
    double intensity_;
    int trials_ = 0;
};

TEST(SimulatedTracks, ErrorsOfAGuessAreThePriors) {
    // 0 − T with T ~ N(.3, .5²): RMSE √(.25 + .09), bias −.3, and −1 … 1 holds Φ(1.4) − Φ(−2.6) = .91458.
    TrackSimulation simulation{.guess = 0.3, .checkpoints = {1, 3}, .runs = 20000};
    const auto results = simulate_tracks(Stubborn(0), simulation);
    ASSERT_EQ(results.size(), 2u);
    const ErrorSummary s = summarise(results[1]);
    EXPECT_EQ(s.runs, 20000);
    EXPECT_NEAR(s.rmse, std::sqrt(0.34), 4 * s.rmse_se);
    EXPECT_NEAR(s.bias, -0.3, 4 * s.bias_se);
    EXPECT_NEAR(s.bias_se, 0.5 / std::sqrt(20000), 1e-4);
    EXPECT_NEAR(s.coverage, 0.91458, 4 * s.coverage_se);
    EXPECT_EQ(s.rmse, summarise(results[0]).rmse);
}

TEST(SimulatedTracks, AnswersFollowThePsychometricFunctionBiasOrNot) {
    // The decks are balanced, so that a bias neither helps nor hurts on average.
    constexpr int kTrials = 40000;
    for (const double bias : {0.0, 0.2, -0.5}) {
        for (const double distance : {-3.0, -0.1, 0.0, 0.1, 3.0}) {
            TrackSimulation simulation;
            simulation.observer = {.beta = 2, .delta = 0.04};
            simulation.response_bias = bias;
            TrackObserver observer(simulation, 7);
            int right = 0;
            for (int i = 0; i < kTrials; ++i) right += observer.answers_correctly(observer.threshold() + distance);
            const double expected =
                probability_correct(simulation.observer, threshold_offset(simulation.observer), distance, 0);
            EXPECT_NEAR(right / double{kTrials}, expected, 4 * std::sqrt(expected * (1 - expected) / kTrials))
                << bias << ' ' << distance;
        }
    }
}

TEST(SimulatedTracks, WhoAlwaysSaysArtifactIsRightOnHalfOfEachDeck) {
    TrackSimulation simulation;
    simulation.response_bias = 0.5;
    TrackObserver observer(simulation, 0);
    for (int deck = 0; deck < 50; ++deck) {
        int right = 0;
        for (int card = 0; card < 4; ++card) right += observer.answers_correctly(-100);
        EXPECT_EQ(right, 2);
    }
}

TEST(SimulatedTracks, DependOnTheSeedAloneAndNotOnThreadsOrRuns) {
    TrackSimulation simulation{.checkpoints = {5, 10}, .runs = 40, .jobs = 1};
    const auto alone = simulate_tracks(Quest({}), simulation);
    simulation.jobs = 4;
    simulation.runs = 80;
    const auto together = simulate_tracks(Quest({}), simulation);
    simulation.seed = 2;
    const auto others = simulate_tracks(Quest({}), simulation);
    for (size_t run = 0; run < 40; ++run) {
        EXPECT_EQ(alone[1][run].error, together[1][run].error);
        EXPECT_NE(alone[1][run].error, others[1][run].error);
    }
}

TEST(SimulatedTracks, SummaryOfKnownErrors) {
    const std::vector<TrackResult> two{{0, true}, {2, false}};
    const ErrorSummary s = summarise(two);
    EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(2));
    EXPECT_DOUBLE_EQ(s.rmse_se, 2 / (2 * std::sqrt(2)));  // squares 0 and 4: SE of their mean 2
    EXPECT_DOUBLE_EQ(s.bias, 1);
    EXPECT_DOUBLE_EQ(s.bias_se, 1);
    EXPECT_DOUBLE_EQ(s.coverage, 0.5);
    EXPECT_DOUBLE_EQ(s.coverage_se, std::sqrt(0.125));
    const std::vector<TrackResult> wild{{0.1, true}, {-0.1, true}, {0.1, true}, {-0.1, true}, {50, false}};
    EXPECT_DOUBLE_EQ(summarise(wild).robust_sd, 0.14826);
}

}  // namespace
}  // namespace stairstep
