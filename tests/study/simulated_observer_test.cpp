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
        correct += observer({condition, radius, shown}).response == shown;
    }
    EXPECT_NEAR(correct / static_cast<double>(kTrials), 0.82, 5 * std::sqrt(0.82 * 0.18 / kTrials));
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
             [](SimulatedPopulation& p) { p.shape.delta = 0.9; }}) {
        SimulatedPopulation population;
        spoil(population);
        EXPECT_THROW(require_valid(population), InputError);
    }
}

}  // namespace
}  // namespace stairstep
