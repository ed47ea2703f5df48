#include "analysis/slope_estimate.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "analysis/law_fit.h"
#include "analysis/random_effects.h"
#include "tests/analysis/planted_thresholds.h"

namespace stairstep {
namespace {

SlopeData planted_data(Random random, int observers, double between_sd = 0.16) {
    PlantedStudy study;
    study.slopes = {3};
    study.observers = observers;
    study.between_sd = between_sd;
    std::map<std::string, std::vector<Threshold>> by_observer;
    for (const Threshold& t : study.thresholds(random)) by_observer[t.observer].push_back(t);
    SlopeData data;
    for (const auto& [observer, thresholds] : by_observer) {
        const ObserverLaw law = *fit_observer(thresholds);
        data.observers.push_back({observer, law.ln_slope().value, law.ln_slope_se, law.linear_slope, 0, 0});
        data.thresholds.push_back(thresholds);
    }
    return data;
}

TEST(SlopeEstimate, MethodsHaveNamesThatReadBackAndSayWhatTheyDo) {
    const SlopeData data = planted_data(Random(1), 6);
    for (const SlopeMethod method : kSlopeMethods) {
        EXPECT_EQ(slope_method_named(name(method)), method);
        const SlopeEstimate estimate = slope_estimate(method, data, {.replicates = 200});
        EXPECT_EQ(estimate.name, name(method));
        EXPECT_GT(estimate.method.size(), 20u);
        EXPECT_EQ(estimate.method.find("replicates") != std::string::npos, needs_bootstrap(method));
        EXPECT_TRUE(estimate.ci95.first <= estimate.value && estimate.value <= estimate.ci95.second);
    }
    EXPECT_EQ(slope_method_named("wald"), std::nullopt);
}

TEST(SlopeEstimate, MethodsAgreeWhereManyObserversSpeak) {
    // 100 observers: every method's interval is the same to a few percent of its width.
    const SlopeData data = planted_data(Random(2), 100);
    const SlopeEstimate reference = slope_estimate(SlopeMethod::knapp_hartung, data, {});
    const double width = std::log(reference.ci95.second / reference.ci95.first);
    for (const SlopeMethod method : kSlopeMethods) {
        const SlopeEstimate e = slope_estimate(method, data, {.replicates = 1000, .seed = 4, .jobs = 2});
        // The mean of c lies e^{τ²/2} above its median.
        const double shift = method == SlopeMethod::linear_t ? std::exp(0.16 * 0.16 / 2) : 1;
        EXPECT_NEAR(std::log(e.value / shift / reference.value), 0, 0.15 * width) << e.name;
        EXPECT_NEAR(std::log(e.ci95.first / shift / reference.ci95.first), 0, 0.2 * width) << e.name;
        EXPECT_NEAR(std::log(e.ci95.second / shift / reference.ci95.second), 0, 0.2 * width) << e.name;
    }
}

TEST(SlopeEstimate, SameSeedSameBytesOnAnyNumberOfThreads) {
    const SlopeData data = planted_data(Random(3), 5);
    for (const SlopeMethod method : {SlopeMethod::parametric, SlopeMethod::thresholds, SlopeMethod::bca}) {
        const SlopeEstimate one = slope_estimate(method, data, {.replicates = 300, .seed = 7, .jobs = 1});
        const SlopeEstimate two = slope_estimate(method, data, {.replicates = 300, .seed = 7, .jobs = 2});
        EXPECT_EQ(one.ci95, two.ci95) << one.name;
        EXPECT_NE(one.ci95, slope_estimate(method, data, {.replicates = 300, .seed = 8}).ci95) << one.name;
    }
}

TEST(SlopeEstimate, TwoThousandStudiesOfTenObserversTakeSeconds) {
    // A condition; the bar for four on two cores is 30 s, sanitizers and a busy machine included.
    const SlopeData data = planted_data(Random(4), 10);
    for (const SlopeMethod method : {SlopeMethod::parametric, SlopeMethod::thresholds, SlopeMethod::bca}) {
        const auto start = std::chrono::steady_clock::now();
        slope_estimate(method, data, {.replicates = 2000, .jobs = 2});
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        std::printf("2,000 replicates, %s: %.3f s\n", std::string(name(method)).c_str(), seconds);
        EXPECT_LT(seconds, 30);
    }
}

TEST(SlopeEstimate, ParametricBootstrapsCoverAndBcaNearly) {
    // 150 studies of ten observers: binomial SD .018; of 300 .947 and .897. BCa is known to fall short (.89–.91).
    int parametric = 0;
    int bca = 0;
    constexpr int kStudies = 150;
    for (int i = 0; i < kStudies; ++i) {
        const SlopeData data = planted_data(Random(20).stream(static_cast<uint64_t>(i)), 10);
        const auto covers = [&](SlopeMethod method) {
            const auto [low, high] = slope_estimate(method, data, {.replicates = 400, .jobs = 2}).ci95;
            return low <= 3 && 3 <= high;
        };
        parametric += covers(SlopeMethod::parametric);
        bca += covers(SlopeMethod::bca);
    }
    std::printf("parametric %.3f, BCa %.3f\n", parametric / double(kStudies), bca / double(kStudies));
    EXPECT_GE(parametric, 0.89 * kStudies);
    EXPECT_GE(bca, 0.82 * kStudies);
}

}  // namespace
}  // namespace stairstep
