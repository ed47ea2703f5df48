// The thesis's study (Kreuzer 2017, chapter 4) with its results planted: ten observers, sizes of 5, 10 and 20 px, full contrast,
// 3.47 texels for the step and 2.5 for the stair (figure 4.6). They come back within their intervals.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/law_fit.h"
#include "analysis/planted_study.h"

namespace stairstep {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr int kStudies = 1;  // a tenth of the speed
#else
constexpr int kStudies = 12;
#endif

TEST(ThesisStudy, GivesItsResultsBack) {
    PlantedStudy study;
    study.observers = 10;
    study.design.texels_px = {5, 10, 20};
    study.design.contrasts = {1};
    ASSERT_EQ(study.true_slope(Pattern::step, 1), 3.47);
    ASSERT_NEAR(study.true_slope(Pattern::stair, 1), 2.5, 1e-12);
    int held = 0, worst_held = 0;
    double step = 0, stair = 0, ratio = 0;
    for (int i = 0; i < kStudies; ++i) {
        const Law law = fit_law(simulate_study(study, 2017 + static_cast<uint64_t>(i)), 0.82, "simulated").law;
        ASSERT_EQ(law.conditions.size(), 2u);
        for (const ConditionLaw& c : law.conditions) {
            const bool is_step = c.pattern == Pattern::step;
            const double planted = is_step ? 3.47 : 2.5;
            held += c.slope_ci95.first <= planted && planted <= c.slope_ci95.second;
            (is_step ? step : stair) += std::log(c.slope / planted) / kStudies;
        }
        // The step is the worst case, and a law for both patterns.
        EXPECT_EQ(law.pattern, Pattern::step);
        worst_held += law.slope_ci95.first <= 3.47 && 3.47 <= law.slope_ci95.second;
        ASSERT_EQ(law.comparisons.size(), 1u);
        ratio += std::log(law.comparisons[0].ratio / (3.47 / 2.5)) / kStudies;
    }
    // Observers' SD of .16 leaves a study's ln c an error of .055.
    const double bound = 3 * 0.055 / std::sqrt(kStudies);
    EXPECT_LT(std::abs(step), bound);
    EXPECT_LT(std::abs(stair), bound);
    EXPECT_LT(std::abs(ratio), bound);
    if (kStudies >= 12) {
        // Of 24 intervals of 95 %, fewer than 20 come about once in 200 times, pairs of a study being alike.
        EXPECT_GE(held, 20);
        EXPECT_GE(worst_held, 10);
    }
}

}  // namespace
}  // namespace stairstep
