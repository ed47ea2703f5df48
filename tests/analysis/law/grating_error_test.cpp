// The closed form against gratings sampled and averaged one by one.
#include "analysis/law/grating_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

/// Light through the grating from 0 to t.
double light_to(const Grating& grating, double t) {
    const double periods = std::floor(t / grating.period);
    return periods * grating.gap + std::min(t - periods * grating.period, grating.gap);
}

/// Rendered less true at a place within a texel [0, texel), the grating shifted by `phase`.
double error_at(const Grating& grating, double texel, double radius, double place, double phase) {
    const double low = place - radius;
    const double high = place + radius;
    double lit = 0;
    for (double i = std::floor(low / texel); i * texel < high; ++i) {
        const double middle = (i + 0.5) * texel + phase;
        if (middle - grating.period * std::floor(middle / grating.period) < grating.gap) {
            lit += std::min(high, (i + 1) * texel) - std::max(low, i * texel);
        }
    }
    return (lit - (light_to(grating, high + phase) - light_to(grating, low + phase))) / (2 * radius);
}

/// Over a lattice of places and phases.
double counted_rmse(const Grating& grating, double texel, double radius) {
    constexpr int kSteps = 400;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const double error =
                error_at(grating, texel, radius, texel * (i + 0.5) / kSteps, grating.period * (j + 0.5) / kSteps);
            sum += error * error;
        }
    }
    return std::sqrt(sum / (kSteps * kSteps));
}

TEST(GratingError, HasItsAnchors) {
    EXPECT_NEAR(grating_rmse({0.5, 1}, 1, 3.47), 0.500, 5e-4);
    EXPECT_NEAR(grating_rmse({1, 2}, 1, 3.47), 0.036, 5e-4);
    EXPECT_NEAR(grating_rmse({1.5, 3}, 1, 3.47), 0.168, 5e-4);
    EXPECT_NEAR(grating_rmse({3.5, 7}, 1, 3.47), 0.071, 5e-4);
}

TEST(GratingError, IsWhatCountingFinds) {
    Random random(7);
    for (int i = 0; i < 30; ++i) {
        const double texel = 0.01 + random.uniform();
        const double radius = texel * (1 + 9 * random.uniform());
        const double period = texel * std::exp2(5 * random.uniform() - 2);
        const Grating grating{period * (0.05 + 0.9 * random.uniform()), period};
        EXPECT_NEAR(grating_rmse(grating, texel, radius), counted_rmse(grating, texel, radius), 2e-3)
            << "gap " << grating.gap / texel << ", period " << period / texel << ", radius " << radius / texel
            << " texels";
    }
}

// Of whole texels a period, each gap is rounded like its neighbours.
TEST(GratingError, WholePeriodsRoundEachGapAlike) {
    for (const double period : {1.0, 2.0, 3.0, 4.0, 9.0}) {
        for (const double share : {0.11, 0.25, 0.5, 0.83}) {
            const double gap = share * period;
            const double f = gap - std::floor(gap);
            EXPECT_NEAR(grating_rmse({gap, period}, 1, 100), std::sqrt(f * (1 - f)) / period, 4e-3)
                << gap << " of " << period;
        }
    }
}

// Gaps and bars change places: dark is light's complement.
TEST(GratingError, BarsAreAsHardAsGaps) {
    for (const double period : {0.4, 1.1, 2.7, 8.0}) {
        EXPECT_NEAR(grating_rmse({0.3 * period, period}, 1, 3.47), grating_rmse({0.7 * period, period}, 1, 3.47), 1e-9);
    }
}

TEST(GratingError, KeepsItsUnits) {
    EXPECT_NEAR(grating_rmse({0.03, 0.06}, 0.05, 0.2), grating_rmse({30, 60}, 50, 200), 1e-12);
}

TEST(GratingError, RefusesNonsense) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(grating_rmse({bad, 1}, 1, 3), InputError) << bad;
        EXPECT_THROW(grating_rmse({0.5, bad}, 1, 3), InputError) << bad;
        EXPECT_THROW(grating_rmse({0.5, 1}, bad, 3), InputError) << bad;
        EXPECT_THROW(grating_rmse({0.5, 1}, 1, bad), InputError) << bad;
    }
    EXPECT_THROW(grating_rmse({1, 1}, 1, 3), InputError);
    EXPECT_THROW(grating_rmse({0.5, 1}, 1, 0.9), InputError);
    EXPECT_THROW(grating_rmse({0.5, 91}, 1, 3), InputError);
    EXPECT_THROW(grating_rmse({0.04, 0.09}, 1, 3), InputError);
}

}  // namespace
}  // namespace stairstep
