#include "analysis/threshold_posterior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/overdispersion.h"
#include "stimuli/gauss_legendre.h"
#include "stimuli/random.h"
#include "study/engines/quest.h"
#include "study/psychometric.h"

namespace stairstep {
namespace {

std::vector<PooledTrials> constant_stimuli(Random& random, const PsychometricShape& truth, double threshold,
                                           int trials) {
    std::vector<PooledTrials> result;
    for (int i = 0; i < trials; ++i) {
        const double x = threshold - 0.3 + 0.6 * (i % 7) / 6;
        const bool correct = random.uniform() < probability_correct(truth, threshold_offset(truth), x, threshold);
        result.push_back({x, correct, 1});
    }
    return result;
}

/// Strengths that never repeat, around a threshold at 0.
std::vector<PooledTrials> spread_trials(Random& random, const PsychometricShape& truth, int trials) {
    std::vector<PooledTrials> result;
    for (int i = 0; i < trials; ++i) {
        const double x = 0.25 * random.normal();
        result.push_back({x, random.uniform() < probability_correct(truth, threshold_offset(truth), x, 0), 1});
    }
    return result;
}

struct Moments {
    double mean, sd;
};

/// The definition, by the plain rectangle rule in T, ln β and δ with log_likelihood of study/psychometric.h.
Moments direct(const std::vector<PooledTrials>& trials, const PosteriorSettings& s) {
    double low = INFINITY, high = -INFINITY;
    for (const PooledTrials& t : trials) {
        low = std::min(low, t.strength);
        high = std::max(high, t.strength);
    }
    const int betas = 60, deltas = 60, points = 600;
    const QuadratureRule rule = gauss_legendre(deltas / 4, 0, s.prior.largest_lapse);
    double mass = 0, first = 0, second = 0;
    const double width = high - low + 2 * s.margin;
    for (int b = 0; b < betas / 2; ++b) {
        const double z = -3 + 6.0 * b / (betas / 2 - 1);
        const double beta = s.prior.median_beta * std::exp(z * s.prior.ln_beta_sd);
        for (size_t d = 0; d < rule.nodes.size(); ++d) {
            const PsychometricShape shape{beta, 0.5, rule.nodes[d], s.p_threshold};
            const double offset = threshold_offset(shape);
            const double end = b == 0 || b == betas / 2 - 1 ? 0.5 : 1.0;
            for (int i = 0; i < points; ++i) {
                const double t = low - s.margin + width * (i + 0.5) / points;
                const double beyond = std::max({0.0, low - t, t - high}) / s.beyond_sd;
                double log_p = -z * z / 2 - rule.nodes[d] / s.prior.mean_lapse - beyond * beyond / 2;
                for (const PooledTrials& trial : trials) {
                    log_p += trial.count * log_likelihood(shape, offset, trial.strength, t, trial.correct);
                }
                const double p = std::exp(log_p + 20) * rule.weights[d] * end;
                mass += p;
                first += p * t;
                second += p * t * t;
            }
        }
    }
    const double mean = first / mass;
    return {mean, std::sqrt(second / mass - mean * mean)};
}

TEST(ThresholdPosterior, IsTheDefinitionsPosterior) {
    Random random(1);
    for (const int trials : {12, 40}) {
        for (const double p : {0.75, 0.82}) {
            const auto track = spread_trials(random, {.beta = 3, .delta = 0.02, .p_threshold = p}, trials);
            PosteriorSettings settings;
            settings.p_threshold = p;
            settings.refinement = 3;
            const ThresholdPosterior fine = threshold_posterior(pool(track), settings);
            const Moments truth = direct(track, settings);
            EXPECT_NEAR(fine.mean, truth.mean, 1e-3 * truth.sd);
            EXPECT_NEAR(fine.sd, truth.sd, 1e-3 * truth.sd);
            // The grid as fits use it.
            settings.refinement = 1;
            const ThresholdPosterior usual = threshold_posterior(pool(track), settings);
            EXPECT_NEAR(usual.mean, truth.mean, 0.01 * truth.sd);
            EXPECT_NEAR(usual.sd, truth.sd, 0.01 * truth.sd);
            EXPECT_NEAR(usual.ci95.first, fine.ci95.first, 0.02 * truth.sd);
            EXPECT_NEAR(usual.ci95.second, fine.ci95.second, 0.02 * truth.sd);
        }
    }
}

TEST(ThresholdPosterior, PoolingChangesNothing) {
    Random random(2);
    const auto track = constant_stimuli(random, {.beta = 3, .delta = 0.02}, -0.5, 210);
    const auto pooled = pool(track);
    EXPECT_LE(pooled.size(), 14u);
    auto sorted = pooled;
    sorted.clear();
    for (const PooledTrials& level : pooled) {
        for (int i = 0; i < level.count; ++i) sorted.push_back({level.strength, level.correct, 1});
    }
    const ThresholdPosterior one_by_one = threshold_posterior(sorted, {});
    const ThresholdPosterior together = threshold_posterior(pooled, {});
    EXPECT_NEAR(together.mean, one_by_one.mean, 1e-9);
    EXPECT_NEAR(together.sd, one_by_one.sd, 1e-9);
    EXPECT_NEAR(together.ci95.first, one_by_one.ci95.first, 1e-9);
}

TEST(ThresholdPosterior, MovesWithTheScale) {
    // Sizes of 10⁻³ and 10⁶: strengths moved as a whole move T and nothing else.
    Random random(3);
    const auto track = spread_trials(random, {}, 60);
    const ThresholdPosterior here = threshold_posterior(pool(track), {});
    for (const double shift : {-3.0, 6.0, 300.0}) {
        auto moved = track;
        for (PooledTrials& t : moved) t.strength += shift;
        const ThresholdPosterior there = threshold_posterior(pool(moved), {});
        EXPECT_NEAR(there.mean, here.mean + shift, 1e-9);
        EXPECT_NEAR(there.sd, here.sd, 1e-9);
    }
    // A wild pair of strengths beside the others, which say nothing new but that T may lie anywhere between them: next to no
    // mass, though far away.
    auto wild = track;
    wild.push_back({-600, true, 1});
    wild.push_back({600, true, 1});
    const ThresholdPosterior with_wild = threshold_posterior(pool(wild), {});
    EXPECT_NEAR(with_wild.ci95.first, here.ci95.first, 0.5 * here.sd);
    EXPECT_NEAR(with_wild.ci95.second, here.ci95.second, 0.5 * here.sd);
}

TEST(ThresholdPosterior, IsFiniteForAnyAnswers) {
    for (const int count : {1, 2, 500}) {
        for (const int kind : {0, 1, 2, 3}) {
            std::vector<PooledTrials> track;
            for (int i = 0; i < count; ++i) {
                const bool correct = kind == 0 || (kind >= 2 && (i % 2 == 0) == (kind == 2));
                track.push_back({kind == 3 ? 0.1 * (i % 2) : 0.01 * i, correct, 1});
            }
            for (const bool overdispersed : {false, true}) {
                if (overdispersed && count > 2) continue;
                PosteriorSettings settings;
                settings.overdispersed = overdispersed;
                const ThresholdPosterior p = threshold_posterior(pool(track), settings);
                EXPECT_TRUE(std::isfinite(p.mean) && std::isfinite(p.overdispersion)) << count << " " << kind;
                EXPECT_TRUE(p.sd > 0 && p.ci95.first < p.mean && p.mean < p.ci95.second) << count << " " << kind;
            }
        }
    }
}

/// A step between two strengths: the threshold is there, and as narrow as the steepest functions allow.
TEST(ThresholdPosterior, FindsTheStepOfSeparableAnswers) {
    std::vector<PooledTrials> track;
    for (int i = 0; i < 200; ++i) track.push_back({i < 100 ? -0.4 : 0.4, i >= 100 || i % 2 == 0, 1});
    const ThresholdPosterior p = threshold_posterior(pool(track), {});
    EXPECT_GT(p.ci95.first, -0.4);
    EXPECT_LT(p.ci95.second, 0.4);
}

/// Shares of 95 % intervals that hold the planted threshold, and the SD of its z, over slopes from 2 to 5. The posterior is
/// right over its prior, not at every slope: few answers lean towards the middle one.
TEST(ThresholdPosterior, CoversOverSlopesAndThresholdProbabilities) {
    for (const double p : {0.75, 0.82}) {
        int all = 0;
        for (const double beta : {2.0, 3.0, 4.0, 5.0}) {
            const PsychometricShape truth{.beta = beta, .delta = 0.02, .p_threshold = p};
            const Random random(7);
            int covered = 0;
            double squares = 0, sum = 0;
            constexpr int kRuns = 250;
            for (int run = 0; run < kRuns; ++run) {
                Random stream = random.stream(run);
                PosteriorSettings settings;
                settings.p_threshold = p;
                const ThresholdPosterior posterior =
                    threshold_posterior(pool(constant_stimuli(stream, truth, -0.5, 56)), settings);
                covered += posterior.ci95.first <= -0.5 && -0.5 <= posterior.ci95.second;
                const double z = (posterior.mean + 0.5) / posterior.sd;
                sum += z;
                squares += z * z;
            }
            // Binomial SD of 1.4 %.
            EXPECT_GE(covered, 0.91 * kRuns) << "beta " << beta << ", p " << p;
            const double sd = std::sqrt(squares / kRuns - sum * sum / kRuns / kRuns);
            EXPECT_GT(sd, 0.75) << "beta " << beta << ", p " << p;
            EXPECT_LT(sd, 1.15) << "beta " << beta << ", p " << p;
            all += covered;
        }
        EXPECT_GE(all, 930);
        EXPECT_LE(all, 985);
    }
}

/// 10⁵ strengths that all differ, and a million at seven: the grid has to find an interval of 10⁻³ to 10⁻⁴.
TEST(ThresholdPosterior, NarrowsWithTheRootOfTheTrials) {
    const PsychometricShape truth{.beta = 2.7, .delta = 0.03};
    const double information = largest_information(truth);
    Random random(5);
    const ThresholdPosterior different = threshold_posterior(pool(spread_trials(random, truth, 100000)), {});
    EXPECT_LT(std::abs(different.mean), 4 * different.sd);
    EXPECT_LT(different.sd, 3e-3);
    EXPECT_GT(different.sd, 1 / std::sqrt(1e5 * information));
    const ThresholdPosterior pooled = threshold_posterior(pool(constant_stimuli(random, truth, -0.5, 1000000)), {});
    EXPECT_LT(std::abs(pooled.mean + 0.5), 4 * pooled.sd);
    EXPECT_LT(pooled.sd, 1e-3);
    EXPECT_GT(pooled.sd, 1 / std::sqrt(1e6 * information));
    EXPECT_NEAR(pooled.ci95.second - pooled.ci95.first, 3.92 * pooled.sd, 0.02 * pooled.sd);
    EXPECT_LT(pooled.low_end_share + pooled.high_end_share, 1e-12);
}

TEST(Overdispersion, IsTheBetaBinomial) {
    for (const double psi : {0.51, 0.8, 0.99}) {
        for (const double eta : {0.0, 0.0005, 0.01, 0.2, 0.5}) {
            EXPECT_NEAR(beta_binomial_log_likelihood(1, 0, psi, eta), std::log(psi), 1e-12);
            EXPECT_NEAR(beta_binomial_log_likelihood(0, 1, psi, eta), std::log1p(-psi), 1e-9);
            // All sequences of 80 together have probability 1; beyond 64 the other formula.
            double sum = 0;
            for (int k = 0; k <= 80; ++k) {
                sum += std::exp(std::lgamma(81) - std::lgamma(k + 1) - std::lgamma(81 - k) +
                                beta_binomial_log_likelihood(k, 80 - k, psi, eta));
            }
            EXPECT_NEAR(sum, 1, 1e-9) << psi << " " << eta;
        }
    }
    // ν = 2 around ½: any number of right answers is as likely.
    const double eta = 1 / std::sqrt(3.0);
    EXPECT_NEAR(beta_binomial_log_likelihood(3, 2, 0.5, eta), std::log(1 / 60.0), 1e-12);
}

TEST(Overdispersion, WidensBlockedIntervalsAndLeavesAdaptiveTracksAlone) {
    PosteriorSettings independent, overdispersed;
    overdispersed.overdispersed = true;
    // Blocks of 60 whose own probabilities scatter: 7 strengths, each shown once.
    Random random(9);
    const PsychometricShape truth{.beta = 3, .delta = 0.02};
    std::vector<PooledTrials> blocks;
    for (int level = 0; level < 7; ++level) {
        const double x = -0.3 + 0.1 * level;
        // Half of the blocks' trials are answered 0.18 log10 units better or worse.
        const double moved = x + 0.18 * (level % 2 == 0 ? 1 : -1);
        for (int i = 0; i < 60; ++i) {
            blocks.push_back({x, random.uniform() < probability_correct(truth, threshold_offset(truth), moved, 0), 1});
        }
    }
    const ThresholdPosterior narrow = threshold_posterior(pool(blocks), independent);
    const ThresholdPosterior wide = threshold_posterior(pool(blocks), overdispersed);
    EXPECT_GT(wide.overdispersion, 0.1);
    EXPECT_GT(wide.sd, 1.3 * narrow.sd);

    const auto track = spread_trials(random, truth, 40);
    const ThresholdPosterior without = threshold_posterior(pool(track), independent);
    const ThresholdPosterior with = threshold_posterior(pool(track), overdispersed);
    EXPECT_NEAR(with.mean, without.mean, 1e-9);
    EXPECT_NEAR(with.sd, without.sd, 1e-9);
    EXPECT_NEAR(with.overdispersion, 1 / 11.0, 0.002);  // its prior's mean, cut off at ½
}

}  // namespace
}  // namespace stairstep
