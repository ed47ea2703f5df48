#include "analysis/random_effects.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "analysis/statistics.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/number.h"
#include "stimuli/random.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

/// Trials of the BCG vaccine (Colditz et al. 1994): cases and others among the vaccinated, cases and others among controls.
constexpr double kBcg[13][4] = {{4, 119, 11, 128},       {6, 300, 29, 274},        {3, 228, 11, 209},
                                {62, 13536, 248, 12619}, {33, 5036, 47, 5761},     {180, 1361, 372, 1079},
                                {8, 2537, 10, 619},      {505, 87886, 499, 87892}, {29, 7470, 45, 7232},
                                {17, 1699, 65, 1600},    {186, 50448, 141, 27197}, {5, 2493, 3, 2338},
                                {27, 16886, 29, 17825}};

std::vector<Effect> log_relative_risks() {
    std::vector<Effect> effects;
    for (const auto& [a, b, c, d] : kBcg) {
        effects.push_back(
            {std::log(a / (a + b) / (c / (c + d))), std::sqrt(1 / a - 1 / (a + b) + 1 / c - 1 / (c + d))});
    }
    return effects;
}

std::vector<Effect> log_odds_ratios() {
    std::vector<Effect> effects;
    for (const auto& [a, b, c, d] : kBcg) {
        effects.push_back({std::log(a * d / (b * c)), std::sqrt(1 / a + 1 / b + 1 / c + 1 / d)});
    }
    return effects;
}

std::vector<Effect> draw_study(Random& random, size_t observers, double tau, const std::function<double(size_t)>& se) {
    std::vector<Effect> effects;
    for (size_t j = 0; j < observers; ++j) {
        const double truth = tau * random.normal();
        effects.push_back({truth + se(j) * random.normal(), se(j)});
    }
    return effects;
}

double plain_sd(const std::vector<Effect>& effects) {
    std::vector<double> values;
    for (const Effect& e : effects) values.push_back(e.value);
    return mean_with_interval(values).sd;
}

TEST(RandomEffects, EqualMetaforsOnTheBcgTrials) {
    // R, metafor: rma(yi, vi) of escalc(measure="RR", …, data=dat.bcg): tau^2 0.3132, estimate −0.7145, se 0.1798.
    const RandomEffects fit = fit_random_effects(log_relative_risks());
    EXPECT_NEAR(fit.tau * fit.tau, 0.3132, 5e-5);
    EXPECT_NEAR(fit.mean, -0.7145, 5e-5);
    EXPECT_NEAR(fit.model_se, 0.1798, 5e-5);
}

TEST(RandomEffects, EqualVanHouwelingensOnTheBcgTrials) {
    // van Houwelingen et al. (2002), p. 597: maximum likelihood, log odds ratios: tau^2 .302, odds ratio .476 [.336, .675].
    // metafor with test="knha" on the same: [.318, .714].
    const RandomEffects fit = fit_random_effects(log_odds_ratios(), TauMethod::ml);
    EXPECT_NEAR(fit.tau * fit.tau, 0.302, 5e-4);
    EXPECT_NEAR(std::exp(fit.mean), 0.476, 5e-4);
    EXPECT_NEAR(std::exp(fit.mean - 1.959964 * fit.model_se), 0.336, 5e-4);
    EXPECT_NEAR(std::exp(fit.mean + 1.959964 * fit.model_se), 0.675, 5e-4);
    EXPECT_NEAR(std::exp(fit.ci95.first), 0.318, 5e-4);
    EXPECT_NEAR(std::exp(fit.ci95.second), 0.714, 5e-4);
}

TEST(RandomEffects, EqualNormandsStays) {
    // Normand (1999), table IX: mean lengths of stay, REML: −15.12, tau^2 685.20, Wald [−32.67, 2.43]. Variances to 4 places.
    const double yi[] = {-20, -2, -55, -71, -4, 1, 11, -10, 7};
    const double vi[] = {40.5863, 2.0468, 15.2809, 150.2222, 20.1923, 1.2235, 95.3756, 8.0321, 20.6936};
    std::vector<Effect> effects;
    for (size_t i = 0; i < 9; ++i) effects.push_back({yi[i], std::sqrt(vi[i])});
    const RandomEffects fit = fit_random_effects(effects);
    EXPECT_NEAR(fit.mean, -15.12, 0.01);
    EXPECT_NEAR(fit.tau * fit.tau, 685.20, 0.1);
    EXPECT_NEAR(fit.mean + 1.959964 * fit.model_se, 2.43, 0.01);
}

RC_GTEST_PROP(RandomEffects, HaveClosedFormsForEqualErrors, ()) {
    Random random(*rc::gen::arbitrary<uint64_t>());
    const size_t observers = 2 + random.below(14);
    const double se = 0.01 + random.uniform();
    const auto effects = draw_study(random, observers, 0.5, [&](size_t) { return se; });
    const double sd = plain_sd(effects);
    const RandomEffects reml = fit_random_effects(effects);
    const RandomEffects ml = fit_random_effects(effects, TauMethod::ml);
    const double n = static_cast<double>(observers);
    RC_ASSERT(std::abs(reml.tau * reml.tau - std::max(0.0, sd * sd - se * se)) < 1e-6);
    RC_ASSERT(std::abs(ml.tau * ml.tau - std::max(0.0, sd * sd * (n - 1) / n - se * se)) < 1e-6);
    // Knapp–Hartung is then the plain t interval, whatever τ.
    std::vector<double> values;
    for (const Effect& e : effects) values.push_back(e.value);
    const MeanEstimate plain = mean_with_interval(values);
    RC_ASSERT(std::abs(reml.ci95.first - plain.ci95.first) < 1e-9);
    RC_ASSERT(std::abs(reml.ci95.second - plain.ci95.second) < 1e-9);
    // And the profile likelihood with its bound the same, where it finds a spread.
    if (ml.tau > 0.05) {
        const ProfileInterval profile = profile_likelihood(effects, profile_bound(observers));
        RC_ASSERT(std::abs(profile.interval.first - plain.ci95.first) < 1e-4 * (1 + sd));
        RC_ASSERT(std::abs(profile.interval.second - plain.ci95.second) < 1e-4 * (1 + sd));
    }
}

RC_GTEST_PROP(RandomEffects, FollowScaleAndShift, ()) {
    Random random(*rc::gen::arbitrary<uint64_t>());
    const auto effects = draw_study(random, 7, 0.3, [&](size_t j) { return 0.05 + 0.1 * static_cast<double>(j); });
    for (const double scale : {1e-8, 1e8}) {
        std::vector<Effect> scaled = effects;
        for (Effect& e : scaled) e = {scale * (e.value + 2), scale * e.se};
        const RandomEffects fit = fit_random_effects(effects);
        const RandomEffects other = fit_random_effects(scaled);
        RC_ASSERT(std::abs(other.mean / scale - 2 - fit.mean) < 1e-5);
        RC_ASSERT(std::abs(other.tau / scale - fit.tau) < 1e-4);
        RC_ASSERT(std::abs(other.ci95.first / scale - 2 - fit.ci95.first) < 1e-5);
        const Posterior posterior = random_effects_posterior(effects, 0.3);
        const Posterior other_posterior = random_effects_posterior(scaled, 0.3 * scale);
        RC_ASSERT(std::abs(other_posterior.mean_ci95.first / scale - 2 - posterior.mean_ci95.first) < 1e-6);
    }
}

TEST(RandomEffects, HoldWhereThereIsNoSpread) {
    for (const double se : {0.0, 1e-9, 0.1}) {
        const std::vector<Effect> equal(5, Effect{1.25, se});
        const RandomEffects fit = fit_random_effects(equal);
        EXPECT_EQ(fit.mean, 1.25);
        EXPECT_EQ(fit.tau, 0);
        EXPECT_EQ(fit.ci95, std::pair(1.25, 1.25));
        const ProfileInterval profile = profile_likelihood(equal, profile_bound(5));
        EXPECT_TRUE(std::isfinite(profile.interval.first) && std::isfinite(profile.interval.second));
        const Posterior posterior = random_effects_posterior(equal, 0.3);
        EXPECT_TRUE(std::isfinite(posterior.mean_ci95.first) && std::isfinite(posterior.tau_ci95.second)) << se;
    }
    const Effect one{3, 0.2};
    const RandomEffects fit = fit_random_effects(std::span(&one, 1));
    EXPECT_EQ(fit.mean, 3);
    EXPECT_EQ(fit.ci95, std::pair(3.0, 3.0));
    // One observer a billion times as precise as the rest.
    const std::vector<Effect> uneven{{0, 1e-9}, {1, 1}, {2, 1}, {-3, 1}};
    EXPECT_TRUE(std::isfinite(fit_random_effects(uneven).ci95.first));
}

TEST(RandomEffects, PosteriorIsStudentsTWhereThePriorIsFlat) {
    // No errors, τ flat: p(μ) ∝ (SS + n(μ − ȳ)²)^{−(n−1)/2}, Student's t with n − 2 degrees of freedom and scale² SS/(n(n − 2)).
    std::vector<Effect> effects;
    std::vector<double> values{1, 2.5, 2, 4, 3.2, 0.7, 2.2};
    for (const double v : values) effects.push_back({v, 0});
    const MeanEstimate mean = mean_with_interval(values);
    const double n = 7;
    const double scale = mean.sd * std::sqrt((n - 1) / (n * (n - 2)));
    const Posterior posterior = random_effects_posterior(effects, 1e7);
    EXPECT_NEAR(posterior.mean, mean.mean, 1e-6);
    EXPECT_NEAR(posterior.mean_ci95.first, mean.mean - t_quantile(0.975, n - 2) * scale, 2e-4);
    EXPECT_NEAR(posterior.mean_ci95.second, mean.mean + t_quantile(0.975, n - 2) * scale, 2e-4);
    // τ² is then scaled inverse χ² with n − 2 degrees of freedom; χ²_5's quantiles .025, .5 and .975.
    const double squares = mean.sd * mean.sd * (n - 1);
    EXPECT_NEAR(posterior.tau_ci95.first, std::sqrt(squares / 12.83250), 2e-3);
    EXPECT_NEAR(posterior.tau, std::sqrt(squares / 4.351460), 2e-3);
    EXPECT_NEAR(posterior.tau_ci95.second, std::sqrt(squares / 0.8312116), 1e-2);
}

TEST(RandomEffects, ProfileBoundTendsToChiSquare) {
    EXPECT_NEAR(profile_bound(10), 4.501803, 5e-6);
    EXPECT_NEAR(profile_bound(100000), 3.841459, 1e-3);
}

TEST(RandomEffects, AgreeWithDirectMaximisationInOctave) {
    if (run_command("octave-cli --version").exit_code != 0) {
        if (std::getenv("STAIRSTEP_ALLOW_MISSING_ORACLES") != nullptr) {
            GTEST_SKIP() << "not compared with Octave: it isn't installed, and that was allowed";
        }
        FAIL() << "octave is needed (./test.sh installs it); set STAIRSTEP_ALLOW_MISSING_ORACLES=1 to do without";
    }
    // Each study: REML and ML over ln τ and over τ = 0 with fminsearch; the profile's ends with fzero on a nested fminsearch.
    std::string script = R"(1;
function f = reml(tau, y, s)
  w = 1./(tau^2 + s.^2); m = sum(w.*y)/sum(w);
  f = 0.5*(sum(log(tau^2 + s.^2)) + log(sum(w)) + sum(w.*(y - m).^2));
end
function f = ml(m, tau, y, s)
  f = 0.5*sum(log(tau^2 + s.^2) + (y - m).^2./(tau^2 + s.^2));
end
function t = best(f)
  t = 0; v = f(0); o = optimset('TolX', 1e-12, 'TolFun', 1e-14, 'MaxFunEvals', 4000);
  for start = [-6 -4 -2 0 1]
    l = fminsearch(@(l) f(exp(l)), start, o);
    if f(exp(l)) < v - 1e-13, v = f(exp(l)); t = exp(l); end
  end
end
function study(y, s, bound)
  t = best(@(t) reml(t, y, s)); w = 1./(t^2 + s.^2); m = sum(w.*y)/sum(w);
  se = sqrt(sum(w.*(y - m).^2)/(numel(y) - 1)/sum(w));
  prof = @(m) ml(m, best(@(t) ml(m, t, y, s)), y, s);
  [mm, top] = fminbnd(prof, min(y), max(y), optimset('TolX', 1e-10));
  d = @(m) 2*(prof(m) - top) - bound; r = 10*(max(y) - min(y) + max(s));
  o = optimset('TolX', 1e-8);
  printf('R %.12g %.12g %.12g %.12g %.12g %.12g\n', t, m, se, mm, fzero(d, [mm - r, mm], o), fzero(d, [mm, mm + r], o));
end
)";
    Random random(8);
    std::vector<std::vector<Effect>> studies{log_relative_risks()};
    for (int i = 0; i < 5; ++i) {
        studies.push_back(draw_study(random, 4 + random.below(8), 0.16 * i / 2, [&](size_t j) {
            return 0.03 + 0.05 * static_cast<double>((j * 7 + static_cast<size_t>(i)) % 5);
        }));
    }
    for (const auto& effects : studies) {
        std::string y, s;
        for (const Effect& e : effects) {
            y += format_number(e.value) + " ";
            s += format_number(e.se) + " ";
        }
        script += "study([" + y + "], [" + s + "], 3.841458820694124);\n";
    }
    const TemporaryFolder folder;
    write_file(folder.path() / "reml.m", script);
    const CommandResult octave =
        run_command("cd " + folder.path().string() + " && octave-cli --no-gui --norc -q reml.m");
    ASSERT_EQ(octave.exit_code, 0) << octave.errors;
    std::istringstream lines(octave.output);
    for (const auto& effects : studies) {
        std::string mark;
        double tau, mean, se, ml_mean, low, high;
        ASSERT_TRUE(lines >> mark >> tau >> mean >> se >> ml_mean >> low >> high) << octave.output;
        const RandomEffects fit = fit_random_effects(effects);
        EXPECT_NEAR(fit.tau, tau, 1e-5);
        EXPECT_NEAR(fit.mean, mean, 1e-6);
        EXPECT_NEAR(fit.se, se, 1e-6);
        const ProfileInterval profile = profile_likelihood(effects, 3.841458820694124);
        EXPECT_NEAR(profile.mean, ml_mean, 1e-5);
        EXPECT_NEAR(profile.interval.first, low, 1e-5);
        EXPECT_NEAR(profile.interval.second, high, 1e-5);
    }
}

/// Share of so many studies of normal observers around 0 whose interval holds 0.
double coverage(size_t observers, double tau, const std::function<double(size_t)>& se,
                const std::function<std::pair<double, double>(const std::vector<Effect>&)>& interval,
                int kStudies = 2000) {
    int covered = 0;
    for (int i = 0; i < kStudies; ++i) {
        Random random = Random(5).stream(static_cast<uint64_t>(i));
        const auto [low, high] = interval(draw_study(random, observers, tau, se));
        covered += low <= 0 && 0 <= high;
    }
    return covered / static_cast<double>(kStudies);
}

std::pair<double, double> knapp_hartung(const std::vector<Effect>& effects) {
    return fit_random_effects(effects).ci95;
}

double threefold(size_t j) {
    return 0.05 * (1 + static_cast<double>(j % 3));
}

TEST(RandomEffects, KnappHartungCovers) {
    // Binomial SD .005.
    for (const double tau : {0.0, 0.05, 0.16}) {
        for (const size_t observers : {3, 5, 10, 30}) {
            const double share = coverage(observers, tau, threefold, knapp_hartung);
            std::printf("Knapp-Hartung, threefold errors, tau %.2f, %zu observers: %.3f\n", tau, observers, share);
            EXPECT_GE(share, 0.91) << tau << " " << observers;
            EXPECT_LE(share, 0.97) << tau << " " << observers;
        }
    }
}

TEST(RandomEffects, RaisingQToOneWouldCoverTooMuch) {
    // Equal errors and no spread: without it exactly .95.
    const auto equal = [](size_t) { return 0.1; };
    const auto raised = [](const std::vector<Effect>& effects) {
        const RandomEffects fit = fit_random_effects(effects);
        const double half_width =
            t_quantile(0.975, static_cast<double>(effects.size()) - 1) * std::max(fit.se, fit.model_se);
        return std::pair(fit.mean - half_width, fit.mean + half_width);
    };
    for (const size_t observers : {4, 10}) {
        const double share = coverage(observers, 0, equal, knapp_hartung);
        const double share_raised = coverage(observers, 0, equal, raised);
        std::printf("equal errors, tau 0, %zu observers: %.3f, with q >= 1 %.3f\n", observers, share, share_raised);
        EXPECT_NEAR(share, 0.95, 0.016);
        EXPECT_GT(share_raised, 0.97);
    }
}

std::pair<double, double> sandwich(const std::vector<Effect>& effects) {
    return sandwich_interval(effects, fit_random_effects(effects)).ci95;
}

TEST(SandwichInterval, IsThePlainTForEqualErrors) {
    Random random(8);
    for (const size_t observers : {2, 5, 20}) {
        const std::vector<Effect> effects = draw_study(random, observers, 0.1, [](size_t) { return 0.07; });
        const RandomEffects fit = fit_random_effects(effects);
        const SandwichInterval interval = sandwich_interval(effects, fit);
        EXPECT_NEAR(interval.degrees_of_freedom, static_cast<double>(observers) - 1, 1e-9);
        EXPECT_NEAR(interval.se, fit.se, 1e-12);
        EXPECT_NEAR(interval.ci95.first, fit.ci95.first, 1e-10);
        EXPECT_NEAR(interval.ci95.second, fit.ci95.second, 1e-10);
    }
}

TEST(SandwichInterval, HasTheMomentsOfItsModel) {
    // V over studies whose τ is known: mean 1/Σw, and 2·mean²/variance its degrees of freedom.
    const auto se = [](size_t j) { return j < 2 ? 0.05 : 0.2; };
    double sum = 0, squares = 0, degrees = 0, mean_variance = 0;
    constexpr int kStudies = 40000;
    for (int i = 0; i < kStudies; ++i) {
        Random random = Random(12).stream(static_cast<uint64_t>(i));
        const std::vector<Effect> effects = draw_study(random, 8, 0.1, se);
        const RandomEffects fit = random_effects_at(effects, 0.1);
        const SandwichInterval interval = sandwich_interval(effects, fit);
        const double variance = interval.se * interval.se;
        sum += variance / kStudies;
        squares += variance * variance / kStudies;
        degrees = interval.degrees_of_freedom;
        mean_variance = fit.model_se * fit.model_se;
    }
    EXPECT_NEAR(sum, mean_variance, 0.02 * mean_variance);
    EXPECT_NEAR(2 * sum * sum / (squares - sum * sum), degrees, 0.06 * degrees);
    EXPECT_LT(degrees, 6);
}

TEST(SandwichInterval, HoldsWhereFewObserversHaveTheWeight) {
    // Two of ten measured ten times as well. Knapp and Hartung's weights are two observers', their t is that of ten; the sandwich
    // knows, and the plain mean doesn't mind. Binomial SD .005.
    const auto tenfold = [](size_t j) { return j < 2 ? 0.03 : 0.3; };
    const double weighted = coverage(10, 0.16, tenfold, knapp_hartung);
    const double robust = coverage(10, 0.16, tenfold, sandwich);
    const double plain = coverage(10, 0.16, tenfold, [](const std::vector<Effect>& effects) {
        std::vector<double> values;
        for (const Effect& e : effects) values.push_back(e.value);
        return mean_with_interval(values).ci95;
    });
    std::printf("tenfold errors, tau .16, 10 observers: Knapp-Hartung %.3f, sandwich %.3f, plain mean %.3f\n", weighted,
                robust, plain);
    EXPECT_GE(plain, 0.93);
    EXPECT_GE(robust, 0.93);
    EXPECT_LT(weighted, 0.9);
    for (const double tau : {0.0, 0.05, 0.16}) {
        for (const size_t observers : {5, 10, 30}) {
            const double share = coverage(observers, tau, threefold, sandwich);
            EXPECT_GE(share, 0.93) << tau << " " << observers;
            EXPECT_LE(share, 0.975) << tau << " " << observers;
        }
    }
}

TEST(SandwichInterval, IsFiniteWhereOneObserverIsAll) {
    const std::vector<Effect> uneven{{1, 1e-9}, {1.2, 3}, {0.7, 3}};
    const SandwichInterval interval = sandwich_interval(uneven, random_effects_at(uneven, 0));
    EXPECT_TRUE(std::isfinite(interval.ci95.first) && std::isfinite(interval.ci95.second));
    EXPECT_LT(interval.degrees_of_freedom, 1.01);
    const std::vector<Effect> equal{{1, 0}, {1, 0}, {1, 0}};
    const SandwichInterval point = sandwich_interval(equal, fit_random_effects(equal));
    EXPECT_EQ(point.ci95, std::pair(1.0, 1.0));
}

TEST(RandomEffects, ProfileAndPosteriorCover) {
    // Of 2,000 studies .960 and .973 at τ = .05, .945 and .949 at .16. Binomial SD of 400 .011.
    for (const double tau : {0.05, 0.16}) {
        const double profile = coverage(
            10, tau, threefold,
            [](const std::vector<Effect>& e) { return profile_likelihood(e, profile_bound(e.size())).interval; }, 400);
        const double posterior = coverage(
            10, tau, threefold, [](const std::vector<Effect>& e) { return random_effects_posterior(e, 0.3).mean_ci95; },
            400);
        std::printf("tau %.2f, 10 observers: profile %.3f, posterior %.3f\n", tau, profile, posterior);
        EXPECT_GE(profile, 0.912);
        EXPECT_GE(posterior, 0.912);
    }
}

}  // namespace
}  // namespace stairstep
