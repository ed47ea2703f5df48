#include "analysis/psychometric_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <sstream>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/random.h"
#include "study/psychometric.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

constexpr Sigmoid kSigmoids[] = {Sigmoid::weibull, Sigmoid::gaussian, Sigmoid::logistic};

PsychometricFit known(Sigmoid sigmoid, double p, PsychometricParameters<double> parameters) {
    PsychometricFit fit;
    fit.settings.sigmoid = sigmoid;
    fit.settings.p_threshold = p;
    fit.parameters = parameters;
    fit.estimated = true;
    return fit;
}

/// Slopes of about the same steepness for every sigmoid.
double usual_slope(Sigmoid sigmoid) {
    return sigmoid == Sigmoid::weibull ? 3 : sigmoid == Sigmoid::gaussian ? 6 : 10;
}

std::vector<Answer01> answers_of(const PsychometricFit& truth, int count, uint64_t seed, int strengths = 9) {
    Random random(seed);
    std::vector<Answer01> answers;
    for (int i = 0; i < count; ++i) {
        const double x =
            truth.parameters.threshold - 0.4 + 0.8 * static_cast<double>(random.below(strengths)) / (strengths - 1);
        answers.push_back({x, random.uniform() < truth.probability(x)});
    }
    return answers;
}

TEST(PsychometricFunction, HasItsThresholdAndTheProjectsWeibull) {
    for (const Sigmoid sigmoid : kSigmoids) {
        for (const double p : {0.6, 0.75, 0.82}) {
            const PsychometricFit f = known(sigmoid, p, {-0.3, 4, 0.05, 0.5});
            EXPECT_NEAR(f.probability(-0.3), p, 1e-14);
            for (const double q : {0.55, 0.7, 0.9}) EXPECT_NEAR(f.probability(*f.threshold_at(q)), q, 1e-13);
            EXPECT_FALSE(f.threshold_at(0.99));
            EXPECT_FALSE(f.threshold_at(0.5));
        }
    }
    EXPECT_NEAR(known(Sigmoid::gaussian, 0.5, {1, 1, 0, 0}).probability(1 + 1.959963984540054), 0.975, 1e-12);
    EXPECT_NEAR(known(Sigmoid::logistic, 0.5, {1, 1, 0, 0}).probability(1 + std::log(3.0)), 0.75, 1e-14);
    const PsychometricShape shape{3.5, 0.5, 0.02, 0.82};
    const PsychometricFit weibull = known(Sigmoid::weibull, 0.82, {-0.5, 3.5, 0.02, 0.5});
    for (double x = -3; x < 2; x += 0.07) {
        EXPECT_NEAR(weibull.probability(x), probability_correct(shape, threshold_offset(shape), x, -0.5), 1e-14);
    }
}

/// Counts that a function predicts exactly are fitted by that function, with deviance 0.
TEST(PsychometricFit, GivesBackTheFunctionThatPredictsTheCountsExactly) {
    for (const Sigmoid sigmoid : kSigmoids) {
        for (const bool guess_is_free : {false, true}) {
            const PsychometricFit truth =
                known(sigmoid, 0.75, {-0.5, usual_slope(sigmoid), 0.04, guess_is_free ? 0.3 : 0.5});
            std::vector<Level> levels;
            for (int i = 0; i < 15; ++i) {
                const double x = -1.2 + 0.1 * i;
                levels.push_back({x, 1000 * truth.probability(x), 1000});
            }
            PsychometricFitSettings settings{.sigmoid = sigmoid};
            settings.guess_is_free = guess_is_free;
            if (guess_is_free) settings.guess = 0.4;
            const PsychometricFit fit = fit_psychometric(levels, settings);
            EXPECT_EQ(fit.reason, "");
            EXPECT_TRUE(fit.converged);
            EXPECT_NEAR(fit.parameters.threshold, -0.5, 1e-7);
            EXPECT_NEAR(fit.parameters.slope, truth.parameters.slope, 1e-5);
            EXPECT_NEAR(fit.parameters.lapse, 0.04, 1e-6);
            EXPECT_NEAR(fit.parameters.guess, truth.parameters.guess, 1e-6);
            EXPECT_LT(fit.deviance, 1e-7);
        }
    }
}

/// With slope, lapses and guessing known, one parameter is left: its variance is 1/(n·I), I the Fisher information in closed form.
TEST(PsychometricFit, StandardErrorsAreTheInformations) {
    const PsychometricFit truth = known(Sigmoid::weibull, 0.82, {0, 3.5, 0, 0.5});
    std::vector<Level> levels;
    for (int i = 0; i < 11; ++i) {
        const double x = -0.5 + 0.1 * i;
        levels.push_back({x, 10000 * truth.probability(x), 10000});
    }
    const PsychometricFit fit = fit_psychometric(levels, {.p_threshold = 0.82, .largest_lapse = 0});
    ASSERT_TRUE(fit.covariance);
    // Expected = observed information, as the counts are as expected: I_jk = Σ n·∂Ψ_j·∂Ψ_k/(Ψ(1 − Ψ)) over T and b.
    double tt = 0, tb = 0, bb = 0;
    for (const Level& level : levels) {
        const auto psi = [&](double t, double b) {
            return known(Sigmoid::weibull, 0.82, {t, b, 0, 0.5}).probability(level.strength);
        };
        const double h = 1e-6;
        const double by_t = (psi(h, 3.5) - psi(-h, 3.5)) / (2 * h);
        const double by_b = (psi(0, 3.5 + h) - psi(0, 3.5 - h)) / (2 * h);
        const double weight = level.trials / (psi(0, 3.5) * (1 - psi(0, 3.5)));
        if (psi(0, 3.5) > 1 - 1e-12) continue;
        tt += weight * by_t * by_t;
        tb += weight * by_t * by_b;
        bb += weight * by_b * by_b;
    }
    const double determinant = tt * bb - tb * tb;
    EXPECT_NEAR(*fit.threshold_sd(), std::sqrt(bb / determinant), 1e-5 * std::sqrt(bb / determinant));
    EXPECT_NEAR((*fit.covariance)[5], tt / determinant, 1e-4 * tt / determinant);
    // So many answers make the profile a parabola.
    EXPECT_NEAR(fit.threshold_ci95.second - fit.threshold_ci95.first, 3.92 * *fit.threshold_sd(),
                0.01 * *fit.threshold_sd());
}

TEST(PsychometricFit, ProfileIntervalsCover) {
    const PsychometricFit truth = known(Sigmoid::weibull, 0.75, {-0.5, 3, 0.02, 0.5});
    int covered = 0, all = 0;
    for (uint64_t seed = 0; seed < 150; ++seed) {
        const PsychometricFit fit = fit_psychometric(answers_of(truth, 120, seed), {});
        if (!fit.estimated) continue;
        ++all;
        covered += fit.threshold_ci95.first <= -0.5 && -0.5 <= fit.threshold_ci95.second;
    }
    EXPECT_GE(all, 149);
    EXPECT_GE(covered, 0.89 * all);  // binomial SD 1.8 %
}

TEST(PsychometricFit, SaysPlainlyWhatDataCannotTell) {
    const auto reason = [](const std::vector<Answer01>& answers) {
        const PsychometricFit fit = fit_psychometric(answers, {});
        EXPECT_FALSE(std::isnan(fit.threshold_ci95.first) || std::isnan(fit.threshold_ci95.second));
        EXPECT_FALSE(std::isnan(fit.parameters.threshold) || std::isnan(fit.log_likelihood));
        return fit.reason;
    };
    EXPECT_NE(reason({{0, true}}).find("all answers right"), std::string::npos);
    EXPECT_NE(reason({{0, false}, {1, false}}).find("all answers wrong"), std::string::npos);
    EXPECT_NE(reason({{0, false}, {0, true}}).find("one strength only"), std::string::npos);
    std::vector<Answer01> step, falling;
    for (int i = 0; i < 40; ++i) {
        step.push_back({i < 20 ? -0.2 : 0.2, i >= 20 || i % 2 == 0});
        falling.push_back({i < 20 ? -0.2 : 0.2, i < 20 || i % 2 == 0});
    }
    EXPECT_NE(reason(step), "");
    EXPECT_NE(reason(falling), "");
    const PsychometricFit fit = fit_psychometric(step, {});
    EXPECT_GE(fit.parameters.threshold, -0.2 - 0.01);
    EXPECT_LE(fit.parameters.threshold, 0.2 + 0.01);
    EXPECT_THROW(fit_psychometric(std::vector<Answer01>{}, {}), InputError);
    EXPECT_THROW(fit_psychometric(std::vector<Answer01>{{NAN, true}}, {}), InputError);
    EXPECT_THROW(fit_psychometric(std::vector<Answer01>{{0, true}}, {.p_threshold = 0.4}), InputError);
}

TEST(PsychometricFit, MovesWithTheScaleAndHoldsForRepeatedRows) {
    const PsychometricFit truth = known(Sigmoid::weibull, 0.75, {0, 3, 0.02, 0.5});
    const std::vector<Answer01> answers = answers_of(truth, 300, 3);
    const PsychometricFit here = fit_psychometric(answers, {});
    for (const double shift : {-3.0, 6.0}) {
        std::vector<Answer01> moved = answers;
        for (Answer01& a : moved) a.strength += shift;
        const PsychometricFit there = fit_psychometric(moved, {});
        EXPECT_NEAR(there.parameters.threshold, here.parameters.threshold + shift, 1e-6);
        EXPECT_NEAR(there.parameters.slope, here.parameters.slope, 1e-4);
    }
    std::vector<Answer01> often;
    for (int i = 0; i < 3000; ++i) often.insert(often.end(), answers.begin(), answers.end());
    const PsychometricFit many = fit_psychometric(often, {});
    EXPECT_NEAR(many.parameters.threshold, here.parameters.threshold, 1e-6);
    EXPECT_NEAR(many.log_likelihood, 3000 * here.log_likelihood, 1e-6 * std::abs(many.log_likelihood));
    EXPECT_NEAR(*many.threshold_sd() * std::sqrt(3000.0), *here.threshold_sd(), 1e-3 * *here.threshold_sd());
}

/// Against a fit under Octave that shares nothing with ours but the function's equation.
TEST(PsychometricFit, AgreesWithOctavesSimplex) {
    if (run_command("octave-cli --version").exit_code != 0) {
        if (std::getenv("STAIRSTEP_ALLOW_MISSING_ORACLES") != nullptr) {
            GTEST_SKIP() << "not compared with Octave: it isn't installed, and that was allowed";
        }
        FAIL() << "octave is needed (./test.sh installs it); set STAIRSTEP_ALLOW_MISSING_ORACLES=1 to do without this "
                  "comparison";
    }
    std::vector<PsychometricFit> fits;
    std::ostringstream data;
    data.precision(17);
    for (int i = 0; i < 6; ++i) {
        const Sigmoid sigmoid = kSigmoids[i % 3];
        const double p = i < 3 ? 0.75 : 0.82;
        const PsychometricFit truth = known(sigmoid, p, {-0.4 + 0.1 * i, usual_slope(sigmoid), 0.03, 0.5});
        const auto answers = answers_of(truth, 150 * (1 + i % 4), 40 + i, i % 2 == 0 ? 9 : 60);
        fits.push_back(fit_psychometric(answers, {.sigmoid = sigmoid, .p_threshold = p}));
        data << 1 + i % 3 << ' ' << p << " 0.5 0.12 " << fits.back().levels.size() << '\n';
        for (const Level& level : fits.back().levels) {
            data << level.strength << ' ' << level.right << ' ' << level.trials << '\n';
        }
    }
    const std::string name =
        (std::filesystem::temp_directory_path() / ("psychometric" + std::to_string(std::random_device()()))).string();
    write_file(name, data.str());
    const CommandResult octave = run_command(
        "octave-cli --no-gui --norc -q " STAIRSTEP_SOURCE_DIR "/tests/analysis/psychometric_reference.m < " + name);
    std::filesystem::remove(name);
    ASSERT_EQ(octave.exit_code, 0) << octave.errors;
    std::istringstream output(octave.output);
    size_t compared = 0;
    for (std::string line; std::getline(output, line);) {
        if (!line.starts_with("F ")) continue;
        std::istringstream numbers(line.substr(2));
        double threshold, slope, lapse, log_likelihood;
        ASSERT_TRUE(numbers >> threshold >> slope >> lapse >> log_likelihood) << line;
        const PsychometricFit& fit = fits.at(compared++);
        // The likelihood is what both maximise: ours may not be below; parameters where it is round.
        EXPECT_GT(fit.log_likelihood, log_likelihood - 1e-9 * std::abs(log_likelihood)) << compared;
        EXPECT_NEAR(fit.log_likelihood, log_likelihood, 1e-8 * std::abs(log_likelihood)) << compared;
        EXPECT_NEAR(fit.parameters.threshold, threshold, 1e-5) << compared;
        EXPECT_NEAR(fit.parameters.slope / slope, 1, 1e-4) << compared;
        EXPECT_NEAR(fit.parameters.lapse, lapse, 1e-5) << compared;
    }
    EXPECT_EQ(compared, fits.size());
}

}  // namespace
}  // namespace stairstep
