#include "analysis/observer_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/analysis/planted_thresholds.h"

namespace stairstep {
namespace {

Threshold threshold_at(double texel_px, double radius_px, double ln_sd = 0.1) {
    return planted_threshold("o", {Pattern::step, KernelShape::box, 1, texel_px}, radius_px, ln_sd);
}

TEST(FitObserver, RecoversExactLawsOfAllThreeForms) {
    for (const double scale : {1e-8, 1e-3, 1.0, 1e6, 1e8}) {
        std::vector<Threshold> linear, offset, power;
        for (const double a : {5.0, 10.0, 20.0, 30.0}) {
            linear.push_back(threshold_at(a * scale, 3.47 * a * scale));
            offset.push_back(threshold_at(a * scale, (4 + 2.5 * a) * scale));
            power.push_back(threshold_at(a * scale, 5 * scale * std::pow(a, 0.8)));
        }
        const ObserverLaw law = *fit_observer(linear);
        EXPECT_NEAR(law.through_origin.slope, 3.47, 1e-8);
        EXPECT_NEAR(law.linear_slope, 3.47, 1e-8);
        EXPECT_NEAR(law.with_intercept->parameters.intercept / scale, 0, 1e-6);
        EXPECT_NEAR(law.with_exponent->parameters.exponent, 1, 1e-8);
        EXPECT_NEAR(fit_observer(offset)->with_intercept->parameters.intercept / scale, 4, 1e-5);
        EXPECT_NEAR(fit_observer(offset)->with_intercept->parameters.slope, 2.5, 1e-6);
        EXPECT_NEAR(fit_observer(power)->with_exponent->parameters.exponent, 0.8, 1e-7);
        EXPECT_NEAR(fit_observer(power)->with_exponent->parameters.slope * std::pow(scale, -0.2), 5, 1e-6);
    }
}

TEST(FitObserver, WeighsThresholdsByTheirPrecision) {
    // In logarithms the best slope is the weighted mean of ln(r/a), and the exponent a weighted regression: closed forms.
    const std::vector<Threshold> thresholds{threshold_at(5, 20, 0.05), threshold_at(10, 30, 0.2),
                                            threshold_at(20, 70, 0.1)};
    double weights = 0, sum = 0, x_sum = 0, linear = 0;
    for (const Threshold& t : thresholds) {
        const double w = 1 / (t.ln_radius_sd() * t.ln_radius_sd());
        weights += w;
        sum += w * std::log(t.radius_px() / t.condition.texel_px);
        x_sum += w * std::log(t.condition.texel_px);
        linear += w * t.radius_px() / t.condition.texel_px;
    }
    double xx = 0, xy = 0;
    for (const Threshold& t : thresholds) {
        const double w = 1 / (t.ln_radius_sd() * t.ln_radius_sd());
        const double x = std::log(t.condition.texel_px) - x_sum / weights;
        xx += w * x * x;
        xy += w * x * std::log(t.radius_px());
    }
    const ObserverLaw law = *fit_observer(thresholds);
    EXPECT_NEAR(law.ln_slope().value, sum / weights, 1e-9);
    EXPECT_NEAR(law.ln_slope_se, 1 / std::sqrt(weights), 1e-12);
    EXPECT_NEAR(law.linear_slope, linear / weights, 1e-9);
    EXPECT_NEAR(law.with_exponent->parameters.exponent, xy / xx, 1e-8);
    EXPECT_NEAR(law.with_exponent->se, 1 / std::sqrt(xx), 1e-9);
    const Effect alone = *fit_ln_slope(thresholds);
    EXPECT_NEAR(alone.value, law.ln_slope().value, 1e-12);
    EXPECT_NEAR(alone.se, law.ln_slope_se, 1e-12);
}

TEST(FitObserver, StatesTheErrorOfTheIntercept) {
    // Against the spread of 2,000 simulated fits, whose SD is known to 1.6 %; the law is nearly linear within these errors.
    Random random(3);
    double sum = 0, squares = 0, stated = 0;
    constexpr int kFits = 2000;
    for (int i = 0; i < kFits; ++i) {
        std::vector<Threshold> thresholds;
        for (const double a : {5.0, 10.0, 20.0, 30.0}) {
            thresholds.push_back(threshold_at(a, (2 + 3 * a) * std::exp(0.05 * random.normal()), 0.05));
        }
        const ObserverForm form = *fit_observer(thresholds)->with_intercept;
        sum += form.parameters.intercept;
        squares += form.parameters.intercept * form.parameters.intercept;
        stated += form.se / kFits;
    }
    const double sd = std::sqrt(squares / kFits - sum / kFits * sum / kFits);
    EXPECT_NEAR(sum / kFits, 2, 0.1);
    EXPECT_NEAR(stated / sd, 1, 0.06);
}

TEST(FitObserver, RobustFitBoundsAWildThresholdAndNamesIt) {
    std::vector<Threshold> thresholds;
    for (const double a : {5.0, 10.0, 20.0}) thresholds.push_back(threshold_at(a, 3 * a));
    thresholds.push_back(threshold_at(30, 30 * 3 * std::exp(2.0)));
    const ObserverLaw plain = *fit_observer(thresholds);
    const ObserverLaw robust = *fit_observer(thresholds, true);
    EXPECT_NEAR(plain.ln_slope().value, std::log(3) + 0.5, 1e-9);
    // Three residuals of −z balance one held at k: z = k/3, in SD of .1.
    EXPECT_NEAR(robust.ln_slope().value, std::log(3) + 0.1345 / 3, 1e-8);
    EXPECT_NEAR(robust.weight[3], 1.345 / (20 - 1.345 / 3), 1e-8);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(robust.weight[static_cast<size_t>(i)], 1);
    EXPECT_EQ(plain.weight, std::vector<double>(4, 1.0));
    EXPECT_GT(robust.ln_slope_se, plain.ln_slope_se);
}

TEST(FitObserver, SaysWhatTooFewSizesCannotTell) {
    const std::vector<Threshold> one{threshold_at(10, 30), threshold_at(10, 36)};
    const ObserverLaw law = *fit_observer(one);
    EXPECT_NEAR(law.ln_slope().value, std::log(3 * std::sqrt(1.2)), 1e-9);
    EXPECT_FALSE(law.with_intercept || law.with_exponent);
    EXPECT_FALSE(fit_observer({}));
    EXPECT_FALSE(fit_ln_slope({}));

    // Nine decades apart: two points give both forms exactly.
    const ObserverLaw far = *fit_observer({threshold_at(1e-3, 3e-3), threshold_at(1e6, 3e6)});
    ASSERT_TRUE(far.with_intercept && far.with_exponent);
    EXPECT_NEAR(far.with_intercept->parameters.intercept, 0, 1e-9);
    EXPECT_NEAR(far.with_exponent->parameters.exponent, 1, 1e-9);
}

}  // namespace
}  // namespace stairstep
