#include "analysis/influence_figure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/law_fit.h"
#include "tests/analysis/planted_thresholds.h"

namespace stairstep {
namespace {

/// Ten observers with the same slope but one, equal standard errors: leaving j out of a mean of n moves it by (mean − y_j)/(n − 1),
/// in standard errors of sd/√n.
TEST(Influences, AreTheClosedFormOfAMeanAndNameTheWildObserver) {
    std::vector<Threshold> thresholds;
    const int n = 10;
    for (int j = 0; j < n; ++j) {
        for (const double a : {5.0, 10.0}) {
            const double c = 3 * std::exp(j == 4 ? 0.8 : 0.02 * (j % 3));
            thresholds.push_back(
                planted_threshold("o" + std::to_string(j), {Pattern::step, KernelShape::box, 1, a}, c * a, 0.05));
        }
    }
    const LawFit fit = fit_law_to_thresholds(thresholds, 0.82, "planted");
    const ConditionLaw& law = fit.law.conditions.front();
    double mean = 0, squares = 0;
    for (const ObserverSlope& o : law.observer_slopes) mean += o.ln_slope / n;
    for (const ObserverSlope& o : law.observer_slopes) squares += (o.ln_slope - mean) * (o.ln_slope - mean);
    const double se = std::sqrt(squares / (n - 1) / n);

    const std::vector<Influence> all = influences(fit.law);
    ASSERT_EQ(all.size(), n + 2u);
    for (int j = 0; j < n; ++j) {
        const Influence& i = all[static_cast<size_t>(j)];
        EXPECT_EQ(i.left_out, "o" + std::to_string(j));
        const double shift = (mean - law.observer_slopes[static_cast<size_t>(j)].ln_slope) / (n - 1);
        EXPECT_NEAR(std::log1p(i.change), shift, 1e-3);
        EXPECT_NEAR(i.standard_errors, shift / se, 0.02);
        EXPECT_EQ(i.is_flagged, j == 4);
    }
    for (size_t i = n; i < all.size(); ++i) {
        EXPECT_TRUE(all[i].is_size);
        EXPECT_NEAR(all[i].change, 0, 1e-9) << "sizes agree";
        EXPECT_FALSE(all[i].is_flagged);
    }
}

}  // namespace
}  // namespace stairstep
