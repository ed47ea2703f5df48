#include "analysis/law_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

Threshold threshold_at(double texel_px, double radius_px, double ln_sd = 0.1) {
    Threshold t;
    t.observer = "o";
    t.condition.texel_px = texel_px;
    t.log_threshold = std::log10(texel_px / radius_px);
    t.log_threshold_sd = ln_sd / std::log(10);
    t.trials = 40;
    return t;
}

TEST(FitObserver, RecoversExactLawsOfAllThreeForms) {
    for (const double scale : {1e-3, 1.0, 1e6}) {
        std::vector<Threshold> linear, offset, power;
        for (const double a : {5.0, 10.0, 20.0, 30.0}) {
            linear.push_back(threshold_at(a * scale, 3.47 * a * scale));
            offset.push_back(threshold_at(a * scale, (4 + 2.5 * a) * scale));
            power.push_back(threshold_at(a * scale, 5 * std::pow(a * scale, 0.8)));
        }
        EXPECT_NEAR(fit_observer(linear)->through_origin.slope, 3.47, 1e-8);
        EXPECT_NEAR(fit_observer(linear)->with_intercept.intercept / scale, 0, 1e-6);
        EXPECT_NEAR(fit_observer(linear)->with_exponent.exponent, 1, 1e-8);
        EXPECT_NEAR(fit_observer(offset)->with_intercept.intercept / scale, 4, 1e-5);
        EXPECT_NEAR(fit_observer(offset)->with_intercept.slope, 2.5, 1e-6);
        EXPECT_NEAR(fit_observer(power)->with_exponent.exponent, 0.8, 1e-7);
        EXPECT_NEAR(fit_observer(power)->with_exponent.slope, 5, 1e-6);
    }
}

TEST(FitObserver, WeighsThresholdsByTheirPrecision) {
    // In logarithms the best slope is the weighted mean of ln(r/a): a closed form.
    const std::vector<Threshold> thresholds{threshold_at(5, 20, 0.05), threshold_at(10, 30, 0.2),
                                            threshold_at(20, 70, 0.1)};
    double weights = 0, sum = 0;
    for (const Threshold& t : thresholds) {
        const double w = 1 / (t.ln_radius_sd() * t.ln_radius_sd());
        weights += w;
        sum += w * std::log(t.radius_px() / t.condition.texel_px);
    }
    EXPECT_NEAR(fit_observer(thresholds)->through_origin.slope, std::exp(sum / weights), 1e-9);
}

/// A study answered by rule: right wherever the radius is below slope × texel.
std::vector<Trial> study_by_rule(int observers, const std::vector<double>& texels_px, double spread) {
    std::vector<Trial> trials;
    for (int i = 0; i < observers; ++i) {
        const double slope = 3 * std::exp(spread * (i - (observers - 1) / 2.0));
        Random random(static_cast<uint64_t>(i));
        for (const double a : texels_px) {
            for (int k = 0; k < 60; ++k) {
                Trial trial;
                trial.observer = "o" + std::to_string(i);
                trial.condition = {Pattern::step, KernelShape::box, 1, a};
                trial.radius_px = a * slope * std::pow(10, 0.5 - (k + 0.5) / 60);
                const bool right = trial.radius_px < a * slope || random.below(2) == 0;
                trial.response = right ? trial.stimulus : Judgement::line;
                trials.push_back(trial);
            }
        }
    }
    return trials;
}

TEST(FitLaw, GivesIntervalsFromTheSpreadBetweenObservers) {
    const LawFit narrow = fit_law(study_by_rule(8, {5, 10, 20}, 0.01), 0.82, "test");
    const LawFit wide = fit_law(study_by_rule(8, {5, 10, 20}, 0.15), 0.82, "test");
    ASSERT_EQ(narrow.law.conditions.size(), 1u);
    EXPECT_NEAR(narrow.law.slope, 3, 0.3);
    EXPECT_GT(wide.law.slope_ci95.second - wide.law.slope_ci95.first,
              3 * (narrow.law.slope_ci95.second - narrow.law.slope_ci95.first));
    EXPECT_EQ(narrow.law.observers, 8);
    EXPECT_EQ(narrow.law.trials, 8 * 3 * 60);
    EXPECT_EQ(narrow.law.texel_range_px, Interval(5, 20));
}

TEST(FitLaw, TheWorstConditionIsTheLaw) {
    std::vector<Trial> trials = study_by_rule(4, {5, 10}, 0.05);
    std::vector<Trial> easier = study_by_rule(4, {5, 10}, 0.05);
    for (Trial& trial : easier) {
        trial.condition.pattern = Pattern::stair;
        trial.radius_px *= 0.7;
    }
    trials.insert(trials.end(), easier.begin(), easier.end());
    const Law law = fit_law(trials, 0.82, "test").law;
    ASSERT_EQ(law.conditions.size(), 2u);
    EXPECT_EQ(law.pattern, Pattern::step);
    EXPECT_EQ(law.slope, std::max(law.conditions[0].slope, law.conditions[1].slope));
    EXPECT_NEAR(law.conditions[1].slope / law.conditions[0].slope, 0.7, 0.02);
}

TEST(FitLaw, SaysWhatCannotBeEstimated) {
    EXPECT_THROW(fit_law(study_by_rule(1, {5, 10}, 0), 0.82, "test"), FailureError);  // one observer
    EXPECT_THROW(fit_law(study_by_rule(5, {10}, 0.1), 0.82, "test"), FailureError);   // one size
    std::vector<Trial> all_right = study_by_rule(5, {5, 10}, 0.1);
    for (Trial& trial : all_right) trial.response = trial.stimulus;
    EXPECT_THROW(fit_law(all_right, 0.82, "test"), FailureError);

    // One observer who is always right is left out, with a warning, and the others' law stands.
    std::vector<Trial> mixed = study_by_rule(5, {5, 10}, 0.1);
    for (Trial& trial : mixed) {
        if (trial.observer == "o2") trial.response = trial.stimulus;
    }
    const LawFit fit = fit_law(mixed, 0.82, "test");
    EXPECT_EQ(fit.law.conditions[0].observers, 4);
    EXPECT_FALSE(fit.warnings.empty());
}

}  // namespace
}  // namespace stairstep
