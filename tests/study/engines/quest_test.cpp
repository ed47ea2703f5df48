#include "study/engines/quest.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

TEST(Quest, KnowsTheInformationOfATrial) {
    // Known: I* = 17.789 at Ψ = .908 for β 3.5, γ .5, δ .01; the offset to there is .0638.
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

using Answers = std::vector<std::pair<double, bool>>;

/// Mean, SD and two quantiles of a posterior on Quest's grid from its logarithms.
struct Summary {
    double mean = 0;
    double sd = 0;
    double low = 0;
    double high = 0;
};

template <typename LogPosterior>
Summary summary(const QuestSettings& s, const LogPosterior& log_posterior) {
    const int half = static_cast<int>(std::ceil(s.range / s.grain / 2));
    std::vector<long double> p;
    long double largest = -std::numeric_limits<long double>::infinity();
    for (int i = -half; i <= half; ++i) p.push_back(log_posterior(s.guess + i * s.grain));
    for (const long double value : p) largest = std::max(largest, value);
    long double mass = 0, first = 0, second = 0;
    for (int i = -half; i <= half; ++i) {
        long double& value = p[static_cast<size_t>(i + half)];
        value = std::exp(value - largest);
        mass += value;
        first += value * i;
    }
    first /= mass;
    for (int i = -half; i <= half; ++i) second += p[static_cast<size_t>(i + half)] * (i - first) * (i - first);
    const auto quantile = [&](long double order) {
        long double below = 0;
        for (int i = -half; i <= half; ++i) {
            const long double value = p[static_cast<size_t>(i + half)];
            if (value > 0 && below + value >= order * mass)
                return s.guess + s.grain * (i - 0.5L + (order * mass - below) / value);
            below += value;
        }
        return static_cast<long double>(s.guess + half * s.grain);
    };
    return {static_cast<double>(s.guess + s.grain * first), static_cast<double>(s.grain * std::sqrt(second / mass)),
            static_cast<double>(quantile(0.025L)), static_cast<double>(quantile(0.975L))};
}

/// ln of the likelihood in long double, each probability from the digits that matter in it.
long double long_log_likelihood(const PsychometricShape& s, double x, double t, bool correct) {
    const long double not_seen =
        (1 - (s.p_threshold - static_cast<long double>(s.delta) * s.gamma) / (1 - static_cast<long double>(s.delta))) /
        (1 - static_cast<long double>(s.gamma));
    const long double offset = std::log10(-std::log(not_seen)) / s.beta;
    const long double u = std::pow(10.0L, s.beta * (static_cast<long double>(x) - t + offset));
    if (correct) return std::log(s.gamma + (1 - s.delta) * (1 - static_cast<long double>(s.gamma)) * -std::expm1(-u));
    if (s.delta == 0) return std::log(1 - static_cast<long double>(s.gamma)) - u;
    return std::log((1 - static_cast<long double>(s.gamma)) *
                    (s.delta + (1 - static_cast<long double>(s.delta)) * std::exp(-u)));
}

void expect_equal(const Quest& quest, const Summary& truth, double tolerance) {
    const ThresholdEstimate estimate = quest.estimate();
    EXPECT_NEAR(estimate.threshold, truth.mean, tolerance);
    EXPECT_NEAR(estimate.sd, truth.sd, tolerance);
    EXPECT_NEAR(estimate.low, truth.low, tolerance);
    EXPECT_NEAR(estimate.high, truth.high, tolerance);
}

PsychometricShape any_shape() {
    PsychometricShape shape;
    shape.beta = *rc::gen::element(0.1, 0.7, 2.0, 3.5, 9.0, 50.0);
    shape.gamma = *rc::gen::element(0.0, 1e-300, 0.02, 0.25, 0.5);
    shape.delta = *rc::gen::element(0.0, 1e-300, 0.01, 0.2);
    shape.p_threshold = *rc::gen::element(0.55, 0.6, 0.75);
    return shape;
}

/// On the grid, off it, beyond it.
double any_intensity() {
    const double fine = *rc::gen::inRange(-3000, 3000) / 1000.0 + *rc::gen::inRange(0, 1000) * 1e-7;
    return *rc::gen::weightedElement<double>({{12, fine}, {1, 8 * fine}, {1, std::round(fine * 100) / 100}});
}

Answers any_answers(int most) {
    Answers answers;
    const int count = *rc::gen::inRange(0, most + 1);
    for (int i = 0; i < count; ++i) answers.emplace_back(any_intensity(), *rc::gen::arbitrary<bool>());
    return answers;
}

RC_GTEST_PROP(Quest, PosteriorEqualsTheProductOfLikelihoods, ()) {
    QuestSettings settings{.guess = *rc::gen::element(0.0, -0.4), .guess_sd = *rc::gen::element(0.05, 0.5, 1e6)};
    settings.shape = any_shape();
    settings.grain = *rc::gen::element(0.01, 0.037);
    const Answers answers = any_answers(60);
    Quest quest(settings);
    for (const auto& [x, correct] : answers) quest.update(x, correct);
    const Summary truth = summary(settings, [&](double t) {
        long double sum = -0.5L * std::pow((t - static_cast<long double>(settings.guess)) / settings.guess_sd, 2);
        for (const auto& [x, correct] : answers) sum += long_log_likelihood(settings.shape, x, t, correct);
        return sum;
    });
    const ThresholdEstimate estimate = quest.estimate();
    // Where δ is about 0 and u large, rounding of x − T alone moves ln(1 − Ψ) = −u by u·10⁻¹⁵.
    const double tolerance = settings.shape.delta < 0.01 ? 1e-6 : 1e-11;
    RC_ASSERT(std::abs(estimate.threshold - truth.mean) <= tolerance);
    RC_ASSERT(std::abs(estimate.sd - truth.sd) <= tolerance);
    RC_ASSERT(std::abs(estimate.low - truth.low) <= 1e-7);
    RC_ASSERT(std::abs(estimate.high - truth.high) <= 1e-7);
}

RC_GTEST_PROP(Quest, OrderOfTrialsDoesNotMatter, ()) {
    QuestSettings settings;
    settings.shape = any_shape();
    Answers answers = any_answers(300);
    Quest forwards(settings), backwards(settings);
    for (auto it = answers.begin(); it != answers.end(); ++it) forwards.update(it->first, it->second);
    for (auto it = answers.rbegin(); it != answers.rend(); ++it) backwards.update(it->first, it->second);
    const double tolerance = settings.shape.delta < 0.01 ? 1e-6 : 1e-10;
    RC_ASSERT(std::abs(forwards.mean() - backwards.mean()) <= tolerance);
    RC_ASSERT(std::abs(forwards.sd() - backwards.sd()) <= tolerance);
}

TEST(Quest, SameTrialsGiveTheSameBits) {
    Quest first({}), second({});
    Random random(4);
    for (int i = 0; i < 2000; ++i) {
        const double x = random.normal();
        const bool correct = random.uniform() < 0.7;
        first.update(x, correct);
        second.update(x, correct);
        ASSERT_EQ(first.suggest(), second.suggest());
        ASSERT_EQ(first.sd(), second.sd());
    }
}

TEST(Quest, LosesNothingInAMillionTrials) {
    // Two kinds of answer, each half a million times, the one after the other: first the posterior is driven some 10⁶ natural
    // logarithms away from where it will end, then all the way back. The truth is n₁·ln L₁ + n₂·ln L₂.
    constexpr int kTimes = 500000;
    for (const double beta : {0.1, 3.5, 50.0}) {
        QuestSettings settings{.guess_sd = 1e6};
        settings.shape.beta = beta;
        settings.grain = 0.05;
        Quest quest(settings);
        for (int i = 0; i < kTimes; ++i) quest.update(0.35, false);
        EXPECT_GT(quest.mean(), 1);
        for (int i = 0; i < kTimes; ++i) quest.update(-0.2, true);
        const Summary truth = summary(settings, [&](double t) {
            return -0.5L * t * t / 1e12L + kTimes * (long_log_likelihood(settings.shape, 0.35, t, false) +
                                                     long_log_likelihood(settings.shape, -0.2, t, true));
        });
        expect_equal(quest, truth, 1e-6);
    }
}

/// Finite and sensible, whatever was answered.
void expect_sensible(const Quest& quest, const QuestSettings& s) {
    const double half = std::ceil(s.range / s.grain / 2) * s.grain + 1e-9;
    const ThresholdEstimate e = quest.estimate();
    EXPECT_GE(e.threshold, s.guess - half);
    EXPECT_LE(e.threshold, s.guess + half);
    EXPECT_TRUE(e.sd >= 0 && e.sd <= 2 * half) << e.sd;
    EXPECT_LE(e.low, e.high);
    EXPECT_GE(e.low, s.guess - half - s.grain);
    EXPECT_LE(e.high, s.guess + half + s.grain);
    EXPECT_LE(e.low - s.grain, quest.quantile(0.5));
    EXPECT_TRUE(std::isfinite(quest.suggest()));
    EXPECT_TRUE(std::isfinite(quest.mode()));
    EXPECT_LE(quest.quantile(0), quest.quantile(1));
}

TEST(Quest, StaysSensibleAtTheExtremes) {
    for (const double beta : {0.1, 50.0}) {
        for (const double prior_sd : {1e-6, 1e6}) {
            for (const double gamma_and_delta : {0.0, 0.2}) {
                QuestSettings settings{.guess_sd = prior_sd};
                settings.shape = {.beta = beta, .gamma = gamma_and_delta, .delta = gamma_and_delta, .p_threshold = 0.5};
                settings.grain = 0.1;
                Quest quest(settings);
                Random random(8);
                const int trials = beta == 50 && gamma_and_delta == 0 && prior_sd < 1 ? 1000000 : 50000;
                for (int i = 0; i < trials; ++i) {
                    // Contradictions, far beyond the range, or noise.
                    const double x = i % 3 == 0 ? random.normal() : i % 2 == 0 ? 10 : -10;
                    quest.update(i % 1000 == 0 ? 1e3 * x : x, i % 3 == 0 ? random.uniform() < 0.5 : i % 2 != 0);
                    if (i % 10007 == 0) expect_sensible(quest, settings);
                }
                expect_sensible(quest, settings);
                EXPECT_EQ(quest.trials(), trials);
            }
        }
    }
}

TEST(Quest, SurvivesAnyFiniteIntensity) {
    for (const double intensity : {1e300, 1e18, 400.0, 1e-320}) {
        for (const double gamma_and_delta : {0.0, 0.1}) {
            QuestSettings settings;
            settings.shape = {.beta = 50, .gamma = gamma_and_delta, .delta = gamma_and_delta, .p_threshold = 0.5};
            Quest quest(settings);
            for (int i = 0; i < 100; ++i) {
                quest.update(intensity, i % 2 == 0);
                quest.update(-intensity, i % 3 == 0);
                expect_sensible(quest, settings);
            }
        }
    }
    Quest quest({});
    EXPECT_THROW(quest.update(NAN, true), InputError);
    EXPECT_THROW(quest.update(INFINITY, true), InputError);
}

TEST(Quest, PutsTrialsWhereItIsTold) {
    QuestSettings settings;
    const auto placed = [&](QuestPlacement placement, std::optional<double> order = std::nullopt) {
        settings.placement = placement;
        settings.quantile_order = order;
        Quest quest(settings);
        for (const auto& [x, correct] : Answers{{0.3, true}, {-0.1, false}, {0.2, true}, {0, true}})
            quest.update(x, correct);
        return quest;
    };
    const Quest quest = placed(QuestPlacement::mean);
    EXPECT_EQ(quest.suggest(), quest.mean());
    EXPECT_EQ(placed(QuestPlacement::most_informative).suggest(),
              quest.mean() + most_informative_offset(settings.shape));
    EXPECT_EQ(placed(QuestPlacement::mode).suggest(), quest.mode());
    EXPECT_EQ(placed(QuestPlacement::quantile, 0.3).suggest(), quest.quantile(0.3));
    EXPECT_EQ(placed(QuestPlacement::quantile).suggest(), quest.quantile(best_quantile_order(settings.shape)));
    EXPECT_LT(quest.mode(), quest.mean());  // hits leave a tail of high thresholds
    EXPECT_THROW(placed(QuestPlacement::quantile, 0.0), InputError);
    EXPECT_THROW(placed(QuestPlacement::quantile, 1.0), InputError);
}

TEST(Quest, KnowsTheQuantileThatTellsMost) {
    EXPECT_NEAR(best_quantile_order({.beta = 3.5, .gamma = 0.5, .delta = 0}), 0.6, 1e-12);
    // Psychtoolbox's q.quantileOrder for δ .01, from the ends of its table.
    EXPECT_NEAR(best_quantile_order({}), 0.58979246721529532, 1e-12);
    // What an answer tells, by trying.
    const double low = 0.2, high = 1 - 0.05 * 0.8;
    const auto entropy = [](double p) { return -p * std::log(p) - (1 - p) * std::log(1 - p); };
    const auto told = [&](double q) {
        return entropy(low + q * (high - low)) - q * entropy(high) - (1 - q) * entropy(low);
    };
    const double best = best_quantile_order({.beta = 3.5, .gamma = 0.2, .delta = 0.05});
    for (const double q : {best - 1e-3, best + 1e-3, 0.1, 0.5, 0.9}) EXPECT_GT(told(best), told(q)) << q;
}

TEST(Quest, TakesAnyPrior) {
    const Answers answers{{0.3, true}, {-0.1, false}, {0.2, true}};
    const auto after = [&](const QuestSettings& settings) {
        Quest quest(settings);
        for (const auto& [x, correct] : answers) quest.update(x, correct);
        return quest;
    };
    QuestSettings normal{.guess = 0.2, .guess_sd = 0.3};
    QuestSettings same = normal;
    same.log_prior = [](double t) { return 7 - (t - 0.2) * (t - 0.2) / (2 * 0.3 * 0.3); };
    EXPECT_NEAR(after(normal).mean(), after(same).mean(), 1e-12);

    QuestSettings uniform;
    uniform.log_prior = uniform_log_prior();
    EXPECT_NEAR(Quest(uniform).mean(), 0, 1e-12);
    EXPECT_NEAR(Quest(uniform).sd(), 0.01 * std::sqrt((501.0 * 501 - 1) / 12), 1e-12);
    QuestSettings wide{.guess_sd = 1e6};
    EXPECT_NEAR(after(uniform).mean(), after(wide).mean(), 1e-9);

    // Thresholds above 0 are impossible, and remain so.
    QuestSettings half = uniform;
    half.log_prior = [](double t) { return t > 1e-9 ? -std::numeric_limits<double>::infinity() : t; };
    Quest quest(half);
    for (int i = 0; i < 1000; ++i) quest.update(-0.3, false);
    EXPECT_NEAR(quest.mean(), 0, 1e-3);
    EXPECT_LE(quest.estimate().high, 0.005 + 1e-9);

    QuestSettings bad;
    for (const double value :
         {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
        bad.log_prior = [value](double) { return value; };
        EXPECT_THROW(Quest{bad}, InputError) << value;
    }
}

TEST(Quest, DistinguishesIntensitiesBeyondItsRange) {
    Quest near({}), far({});
    near.update(1.9, true);
    far.update(5, true);
    EXPECT_LT(near.mean(), far.mean());  // a hit at 5 says nothing, one at 1.9 rules out thresholds above
}

TEST(Quest, RefusesImpossibleSettings) {
    EXPECT_THROW(Quest({.guess = NAN}), InputError);
    EXPECT_THROW(Quest({.guess_sd = 0}), InputError);
    EXPECT_THROW(Quest({.grain = 0}), InputError);
    EXPECT_THROW(Quest({.grain = 1e-9}), InputError);
    QuestSettings settings;
    for (const double beta : {-1.0, 0.0, 1e-9, 1e9}) {
        settings.shape.beta = beta;
        EXPECT_THROW(Quest{settings}, InputError);
    }
}

}  // namespace
}  // namespace stairstep
