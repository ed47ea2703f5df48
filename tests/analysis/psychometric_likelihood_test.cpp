#include "analysis/psychometric_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stairstep {
namespace {

const std::vector<Level> kLevels{{-0.6, 9, 20}, {-0.4, 11, 20}, {-0.2, 16, 20}, {0, 19, 20}};

TEST(PsychometricLikelihood, FindsTheShareOfOneStrength) {
    // One strength, T alone free: Ψ = k/n, and the information in p, n/(p(1 − p)).
    for (const Sigmoid sigmoid : {Sigmoid::weibull, Sigmoid::gaussian, Sigmoid::logistic}) {
        const std::vector<Level> levels{{-0.3, 30, 40}};
        PsychometricFitSettings settings;
        settings.sigmoid = sigmoid;
        settings.p_threshold = 0.8;
        const PsychometricLikelihood likelihood(levels, settings);
        const PsychometricVector start = likelihood.theta_of({-0.3, 4, 0.02, 0.5});
        LikelihoodOptimum optimum = climb(likelihood, start, {0});
        PsychometricFit fit;
        fit.settings = settings;
        fit.parameters = likelihood.parameters(optimum.theta);
        fit.parameters.threshold += likelihood.middle();
        EXPECT_NEAR(fit.probability(-0.3), 0.75, 1e-6);
        EXPECT_NEAR(optimum.value, 30 * std::log(0.75) + 10 * std::log(0.25), 1e-10);
        const auto matrix = information(likelihood, optimum.theta, {0});
        ASSERT_TRUE(matrix);
        const double slope = (fit.probability(-0.3 + 1e-6) - fit.probability(-0.3 - 1e-6)) / 2e-6;
        EXPECT_NEAR((*matrix)(0, 0), 40 / (0.75 * 0.25) * slope * slope, 1e-3 * (*matrix)(0, 0));
    }
}

TEST(PsychometricLikelihood, GradientIsTheLikelihoods) {
    PsychometricFitSettings settings;
    settings.guess_is_free = true;
    const PsychometricLikelihood likelihood(kLevels, settings);
    const PsychometricVector theta = likelihood.theta_of({-0.25, 3, 0.03, 0.45});
    PsychometricVector gradient;
    double value;
    ASSERT_TRUE(likelihood.evaluate(theta, value, &gradient));
    for (size_t i = 0; i < theta.size(); ++i) {
        PsychometricVector up = theta, down = theta;
        up[i] += 1e-6;
        down[i] -= 1e-6;
        double above, below;
        ASSERT_TRUE(likelihood.evaluate(up, above, nullptr) && likelihood.evaluate(down, below, nullptr));
        EXPECT_NEAR(gradient[i], (above - below) / 2e-6, 1e-5 * (1 + std::abs(gradient[i]))) << i;
    }
    // There and back.
    const PsychometricParameters<double> f = likelihood.parameters(theta);
    EXPECT_NEAR(f.threshold + likelihood.middle(), -0.25, 1e-15);
    EXPECT_NEAR(f.slope, 3, 1e-14);
}

TEST(PsychometricLikelihood, ProfileFallsByItsBound) {
    const PsychometricFitSettings settings;
    const PsychometricLikelihood likelihood(kLevels, settings);
    LikelihoodOptimum best = best_of_starts(likelihood);
    EXPECT_TRUE(finish(likelihood, best));
    for (const double direction : {-1.0, 1.0}) {
        const double end = profile_end(likelihood, best, 2, direction, 0.1);
        if (!std::isfinite(end)) continue;
        std::vector<int> others = likelihood.not_fixed();
        std::erase(others, 0);
        PsychometricVector at = best.theta;
        at[0] = end - likelihood.middle();
        EXPECT_NEAR(2 * (best.value - climb(likelihood, at, others).value), 2, 1e-4) << direction;
        EXPECT_GT(direction * (at[0] - best.theta[0]), 0);
    }
}

}  // namespace
}  // namespace stairstep
