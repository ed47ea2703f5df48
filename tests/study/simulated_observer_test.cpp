#include "study/simulated_observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(SimulatedObserver, AnswersRightAtThresholdAsOftenAsTheThresholdSays) {
    SimulatedObserver observer({}, Random(1), 0);
    const Condition condition{Pattern::step, KernelShape::box, 1, 10};
    const double radius = 10 * observer.true_slope(Pattern::step, 1);
    int correct = 0;
    constexpr int kTrials = 40000;
    for (int i = 0; i < kTrials; ++i) {
        const Judgement shown = i % 2 == 0 ? Judgement::artifact : Judgement::line;
        correct += observer({condition, radius, shown, Task::yes_no, i + 1}).response == shown;
    }
    EXPECT_NEAR(correct / static_cast<double>(kTrials), 0.82, 5 * std::sqrt(0.82 * 0.18 / kTrials));
}

/// Share of right answers to artifacts and to lines, at a radius in units of the observer's own threshold.
std::pair<double, double> shares_right(const SimulatedPopulation& population, double relative_radius, int since_break,
                                       int first_number = 1) {
    const SimulatedObserver observer(population, Random(1), 0);
    const double radius = 10 * observer.true_slope(Pattern::step, 1) * relative_radius;
    constexpr int kTrials = 40000;
    int right[2] = {};
    for (int i = 0; i < kTrials; ++i) {
        const Judgement shown = i % 2 == 0 ? Judgement::artifact : Judgement::line;
        const Answer answer = observer(
            {{Pattern::step, KernelShape::box, 1, 10}, radius, shown, Task::yes_no, first_number + i, since_break});
        right[i % 2] += answer.response == shown;
    }
    return {right[0] / (kTrials / 2.0), right[1] / (kTrials / 2.0)};
}

TEST(SimulatedObserver, LeansTowardsOneAnswerWhereNothingIsSeen) {
    // At ten times the threshold radius next to nothing is seen: "artifact" comes with probability 0.5 + bias.
    const auto [artifact, line] = shares_right({.response_bias = 0.3}, 10, 0);
    EXPECT_NEAR(artifact, 0.8, 0.015);
    EXPECT_NEAR(line, 0.2, 0.015);
    // The mean over both is that of an unbiased observer.
    const auto [artifact_at, line_at] = shares_right({.response_bias = 0.3}, 1, 0);
    EXPECT_NEAR((artifact_at + line_at) / 2, 0.82, 0.01);
}

TEST(SimulatedObserver, TiresAndRecovers) {
    // Far below threshold all errors are lapses, half of them right by chance: δ .02 and after 100 presentations .12.
    const SimulatedPopulation population{.fatigue = 0.1};
    EXPECT_NEAR(shares_right(population, 0.1, 0).first, 0.99, 0.005);
    EXPECT_NEAR(shares_right(population, 0.1, 100).first, 0.94, 0.01);
}

TEST(SimulatedObserver, DriftMovesTheThreshold) {
    // T rises by drift × hundreds of presentations: a radius smaller by that much is then at threshold.
    SimulatedPopulation population{.drift = 0.001};
    const auto [artifact, line] = shares_right(population, std::pow(10, -0.001 * 1000.0), 0, 100'001 - 20'000);
    EXPECT_NEAR((artifact + line) / 2, 0.82, 0.02);
}

TEST(SimulatedObserver, FollowsAnExponentAndDeviates) {
    const auto radius = [](const SimulatedPopulation& population, uint64_t seed, double texel_px) {
        const SimulatedObserver observer(population, Random(seed), 0);
        return observer.true_radius_texels({Pattern::step, KernelShape::box, 1, texel_px}) * texel_px;
    };
    // r(20)/r(5) = 4^p, the same for every observer.
    EXPECT_NEAR(radius({.exponent = 0.8}, 3, 20) / radius({.exponent = 0.8}, 3, 5), std::pow(4, 0.8), 1e-12);
    EXPECT_NEAR(radius({.exponent = 0.8}, 3, 10), radius({}, 3, 10), 1e-12);
    double squares = 0;
    constexpr int kObservers = 5000;
    for (int i = 0; i < kObservers; ++i) {
        const auto seed = static_cast<uint64_t>(i);
        const double deviation = std::log(radius({.deviation_sd = 0.1}, seed, 20) / radius({}, seed, 20));
        squares += deviation * deviation;
    }
    EXPECT_NEAR(std::sqrt(squares / kObservers), 0.1, 0.004);
}

TEST(SimulatedObserver, AnswersDependOnTheNumberOfThePresentationAlone) {
    const SimulatedObserver observer({}, Random(5), 0);
    const Presentation shown{{Pattern::step, KernelShape::box, 1, 10}, 34, Judgement::line, Task::yes_no, 17};
    const Answer first = observer(shown);
    for (int i = 0; i < 5; ++i) observer({shown.condition, 20, Judgement::artifact, Task::yes_no, i + 1});
    const Answer again = observer(shown);
    EXPECT_EQ(first.response, again.response);
    EXPECT_EQ(first.response_time_s, again.response_time_s);
}

TEST(SimulatedObserver, SlopesScatterAsThePopulationSays) {
    const SimulatedPopulation population;
    for (const Pattern pattern : {Pattern::step, Pattern::stair}) {
        for (const double contrast : {1.0, 0.5}) {
            double sum = 0, squares = 0;
            constexpr int kObservers = 20000;
            for (int i = 0; i < kObservers; ++i) {
                SimulatedObserver observer(population, Random(2).stream(i), 0);
                const double deviation =
                    std::log(observer.true_slope(pattern, contrast) / median_slope(population, pattern, contrast));
                sum += deviation;
                squares += deviation * deviation;
            }
            EXPECT_NEAR(sum / kObservers, 0, 5 * 0.16 / std::sqrt(kObservers));
            EXPECT_NEAR(std::sqrt(squares / kObservers), 0.16, 0.005);
        }
    }
    EXPECT_DOUBLE_EQ(median_slope(population, Pattern::step, 1), 3.47);
    EXPECT_DOUBLE_EQ(median_slope(population, Pattern::stair, 1), 2.5);
    EXPECT_NEAR(median_slope(population, Pattern::step, 0.5) / 3.47, 0.96, 1e-12);
}

TEST(SimulatedObserver, RefusesImpossiblePopulations) {
    for (const auto& spoil : std::vector<void (*)(SimulatedPopulation&)>{
             [](SimulatedPopulation& p) { p.step_slope = 0; }, [](SimulatedPopulation& p) { p.step_slope = NAN; },
             [](SimulatedPopulation& p) { p.between_observer_sd = -1; },
             [](SimulatedPopulation& p) { p.shape.delta = 0.9; }, [](SimulatedPopulation& p) { p.shape.beta = 0; },
             [](SimulatedPopulation& p) { p.exponent = 0; }, [](SimulatedPopulation& p) { p.deviation_sd = -0.1; },
             [](SimulatedPopulation& p) { p.response_bias = 0.6; }, [](SimulatedPopulation& p) { p.fatigue = -1; },
             [](SimulatedPopulation& p) { p.drift = NAN; }, [](SimulatedPopulation& p) { p.redo_share = 1; }}) {
        SimulatedPopulation population;
        spoil(population);
        EXPECT_THROW(require_valid(population), InputError);
    }
}

}  // namespace
}  // namespace stairstep
