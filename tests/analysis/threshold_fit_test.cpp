#include "analysis/threshold_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/random.h"
#include "study/psychometric.h"

namespace stairstep {
namespace {

/// Trials at fixed radii around the threshold, answered by a psychometric function.
Track constant_stimuli(double true_threshold, const PsychometricShape& shape, int trials, uint64_t seed) {
    Random random(seed);
    Track track{"o", {Pattern::step, KernelShape::box, 1, 10}, {}};
    for (int i = 0; i < trials; ++i) {
        const double strength = true_threshold - 0.3 + 0.6 * (i % 7) / 6;
        Trial trial;
        trial.condition = track.condition;
        trial.radius_px = 10 * std::pow(10, -strength);
        trial.stimulus = Judgement::artifact;
        const bool correct =
            random.uniform() < probability_correct(shape, threshold_offset(shape), strength, true_threshold);
        trial.response = correct ? Judgement::artifact : Judgement::line;
        track.trials.push_back(trial);
    }
    return track;
}

TEST(ThresholdFit, ComesCloserToThePlantedThresholdTheMoreTrialsThereAre) {
    const double truth = -std::log10(3.47);
    const Threshold few = fit_threshold(constant_stimuli(truth, {}, 70, 1), 0.82);
    const Threshold many = fit_threshold(constant_stimuli(truth, {}, 7000, 1), 0.82);
    EXPECT_NEAR(few.log_threshold, truth, 4 * few.log_threshold_sd);
    EXPECT_NEAR(many.log_threshold, truth, 4 * many.log_threshold_sd);
    EXPECT_NEAR(many.radius_px(), 34.7, 0.6);
    EXPECT_LT(many.log_threshold_sd, few.log_threshold_sd / 5);
}

TEST(ThresholdFit, CoversWhateverTheSteepness) {
    // 95 % intervals over 120 tracks a steepness: binomial SD 2 %; a fixed β = 3.5 would cover 75 % at β = 2.
    for (const double beta : {2.0, 3.5, 5.0}) {
        int covered = 0;
        const PsychometricShape shape{.beta = beta, .delta = 0.02};
        for (uint64_t seed = 0; seed < 120; ++seed) {
            const Threshold t = fit_threshold(constant_stimuli(-0.5, shape, 56, seed), 0.82);
            covered += std::abs(t.log_threshold + 0.5) <= 1.96 * t.log_threshold_sd;
        }
        EXPECT_GE(covered, 108) << "beta " << beta;
    }
}

TEST(ThresholdFit, MovesWithTheProbabilityAsked) {
    const Track track = constant_stimuli(-0.5, {}, 700, 3);
    EXPECT_LT(fit_threshold(track, 0.75).log_threshold, fit_threshold(track, 0.82).log_threshold);
    EXPECT_LT(fit_threshold(track, 0.82).log_threshold, fit_threshold(track, 0.9).log_threshold);
}

TEST(ThresholdFit, SaysWhenTrialsDontBoundTheThreshold) {
    Track all_right = constant_stimuli(-0.5, {}, 20, 4);
    for (Trial& trial : all_right.trials) trial.response = trial.stimulus;
    EXPECT_FALSE(fit_threshold(all_right, 0.82).bounded);
    Track all_wrong = all_right;
    for (Trial& trial : all_wrong.trials) trial.response = Judgement::line;
    EXPECT_FALSE(fit_threshold(all_wrong, 0.82).bounded);
    Track single = all_right;
    single.trials.resize(1);
    const Threshold t = fit_threshold(single, 0.82);
    EXPECT_FALSE(t.bounded);
    EXPECT_TRUE(std::isfinite(t.log_threshold) && std::isfinite(t.log_threshold_sd));
    EXPECT_TRUE(fit_threshold(constant_stimuli(-0.5, {}, 70, 5), 0.82).bounded);
}

TEST(ThresholdFit, GivesACredibleInterval) {
    const Threshold few = fit_threshold(constant_stimuli(-0.5, {}, 28, 6), 0.82);
    const Threshold many = fit_threshold(constant_stimuli(-0.5, {}, 7000, 6), 0.82);
    for (const Threshold& t : {few, many}) {
        EXPECT_LT(t.log_threshold_ci95.first, t.log_threshold);
        EXPECT_GT(t.log_threshold_ci95.second, t.log_threshold);
        EXPECT_EQ(t.overdispersion, 0);
    }
    // Where trials are many the posterior is normal, and no grid shows: far less than its first spacing of 0.02.
    EXPECT_LT(many.log_threshold_sd, 0.012);
    EXPECT_NEAR(many.log_threshold_ci95.second - many.log_threshold_ci95.first, 3.92 * many.log_threshold_sd,
                0.03 * many.log_threshold_sd);
    EXPECT_NEAR(many.log_threshold, -0.5, 4 * many.log_threshold_sd);
}

TEST(ThresholdFit, TakesBlockedAnswersAsOverdispersedWhenAsked) {
    const Track track = constant_stimuli(-0.5, {}, 350, 8);
    const Threshold independent = fit_threshold(track, 0.82);
    const Threshold overdispersed = fit_threshold(track, 0.82, Answers::overdispersed);
    EXPECT_GT(overdispersed.overdispersion, 0);
    EXPECT_LT(overdispersed.overdispersion, 0.15);  // these answers are independent
    EXPECT_GT(overdispersed.log_threshold_sd, independent.log_threshold_sd);
    EXPECT_NEAR(overdispersed.log_threshold, independent.log_threshold, independent.log_threshold_sd);
}

TEST(ThresholdFit, GroupsTrialsByObserverAndCondition) {
    std::vector<Trial> trials;
    for (int i = 0; i < 12; ++i) {
        Trial trial;
        trial.observer = i % 2 == 0 ? "a" : "b";
        trial.condition.texel_px = i % 3 == 0 ? 5 : 10;
        trial.trial = i;
        trials.push_back(trial);
    }
    const std::vector<Track> tracks = tracks_of(trials);
    ASSERT_EQ(tracks.size(), 4u);
    EXPECT_EQ(tracks[0].observer, "a");
    EXPECT_EQ(tracks[0].trials.size(), 2u);
    EXPECT_EQ(tracks[2].trials[0].trial, 2);
    EXPECT_EQ(tracks[2].trials.back().trial, 10);
}

}  // namespace
}  // namespace stairstep
