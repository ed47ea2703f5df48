#include "analysis/psychometric_fit.h"

#include <algorithm>
#include <cmath>

#include "analysis/psychometric_likelihood.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

constexpr int kCount = kPsychometricParameters;
/// χ² with one degree of freedom, .95.
constexpr double kChiSquare95 = 3.841458820694124;

void require(bool holds, const char* problem, const char* remedy) {
    if (!holds) throw InputError("psychometric fit", problem, remedy);
}

void require_valid(const PsychometricFitSettings& s) {
    require(s.guess >= 0 && s.guess < 1, "guess rate not in [0, 1)", "give one in it");
    require(s.largest_lapse >= 0 && s.largest_lapse < 1, "largest lapse rate not in [0, 1)", "give one in it");
    require(s.slopes.first > 0 && s.slopes.second > s.slopes.first && std::isfinite(s.slopes.second),
            "slopes are no interval above 0", "give the smaller one first");
    const double guess = s.guess_is_free ? s.largest_guess : s.guess;
    require(!s.guess_is_free || (s.guess <= s.largest_guess && s.largest_guess < 1 && s.largest_guess > 0),
            "guess rate beyond its largest", "start it lower");
    const double lowest_top = s.guess_is_free ? 1 - s.largest_lapse : 1 - s.largest_lapse * (1 - guess);
    require(s.p_threshold > guess && s.p_threshold < lowest_top,
            "threshold probability not between guessing and what lapses leave", "move it, or allow fewer lapses");
}

}  // namespace

std::vector<Level> levels_of(const std::vector<Answer01>& answers) {
    std::vector<Level> levels;
    levels.reserve(answers.size());
    for (const Answer01& answer : answers) levels.push_back({answer.strength, answer.correct ? 1.0 : 0.0, 1});
    std::sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.strength < b.strength; });
    size_t kept = 0;
    for (size_t k = 1; k < levels.size(); ++k) {
        if (levels[k].strength == levels[kept].strength) {
            levels[kept].right += levels[k].right;
            levels[kept].trials += levels[k].trials;
        } else {
            levels[++kept] = levels[k];
        }
    }
    if (!levels.empty()) levels.resize(kept + 1);
    return levels;
}

double deviance_residual(const Level& level, double wrong) {
    const double right_share = level.right / level.trials;
    double half = 0;
    if (level.right > 0) half += level.right * std::log(right_share / (1 - wrong));
    if (level.right < level.trials) half += (level.trials - level.right) * std::log((1 - right_share) / wrong);
    return std::copysign(std::sqrt(std::max(0.0, 2 * half)), right_share - (1 - wrong));
}

double PsychometricFit::probability(double strength) const {
    const double z_p = sigmoid_at_threshold(settings.sigmoid, settings.p_threshold, parameters);
    return 1 - probability_wrong(settings.sigmoid, parameters, z_p, strength);
}

std::optional<double> PsychometricFit::threshold_at(double p) const {
    if (!estimated || !(p > parameters.guess && p < 1 - parameters.lapse * (1 - parameters.guess))) return std::nullopt;
    return parameters.threshold + (sigmoid_at_threshold(settings.sigmoid, p, parameters) -
                                   sigmoid_at_threshold(settings.sigmoid, settings.p_threshold, parameters)) /
                                      parameters.slope;
}

std::optional<double> PsychometricFit::threshold_sd() const {
    if (!covariance || at_bound[0]) return std::nullopt;
    return std::sqrt((*covariance)[0]);
}

PsychometricFit fit_psychometric(const std::vector<Answer01>& answers, const PsychometricFitSettings& settings) {
    return fit_psychometric(levels_of(answers), settings);
}

PsychometricFit fit_psychometric(const std::vector<Level>& levels, const PsychometricFitSettings& settings) {
    require_valid(settings);
    require(!levels.empty(), "no trials", "record some");
    double right = 0;
    double trials = 0;
    for (const Level& level : levels) {
        require(std::isfinite(level.strength) && std::abs(level.strength) < 1000, "a strength that is no number",
                "give positive sizes and radii");
        require(level.trials > 0 && level.right >= 0 && level.right <= level.trials, "impossible counts",
                "give right answers of trials");
        right += level.right;
        trials += level.trials;
    }
    PsychometricFit fit;
    fit.settings = settings;
    fit.levels = levels;
    fit.threshold_ci95 = {-INFINITY, INFINITY};
    if (right == trials || right == 0) {
        fit.reason = right == 0 ? "all answers wrong: the threshold is bounded below alone"
                                : "all answers right: the threshold is bounded above alone";
        return fit;
    }
    if (levels.size() == 1) {
        fit.reason = "one strength only: it takes two to tell threshold and slope";
        return fit;
    }

    const PsychometricLikelihood likelihood(fit.levels, fit.settings);
    LikelihoodOptimum best = best_of_starts(likelihood);
    if (!std::isfinite(best.value)) {
        fit.reason = "no function explains these answers: wrong ones where none can be";
        return fit;
    }
    fit.converged = finish(likelihood, best);
    fit.estimated = true;
    const std::vector<int> free = likelihood.inside(best.theta);
    fit.at_bound.fill(true);
    for (const int i : free) fit.at_bound[i] = false;
    fit.parameters = likelihood.parameters(best.theta);
    fit.parameters.threshold += likelihood.middle();
    fit.log_likelihood = best.value;

    const double z_p = sigmoid_at_threshold(settings.sigmoid, settings.p_threshold, fit.parameters);
    for (const Level& level : fit.levels) {
        const double wrong = probability_wrong(settings.sigmoid, fit.parameters, z_p, level.strength);
        fit.deviance_residuals.push_back(deviance_residual(level, wrong));
        fit.deviance += fit.deviance_residuals.back() * fit.deviance_residuals.back();
    }

    if (const auto matrix = information(likelihood, best.theta, free); matrix && !free.empty()) {
        if (const auto inverse = invert(likelihood, *matrix, free)) {
            fit.covariance.emplace();
            fit.covariance->fill(0);
            const auto unit = [&](int i) { return i == 1 ? fit.parameters.slope : 1.0; };  // from ln b to b
            for (size_t j = 0; j < free.size(); ++j) {
                for (size_t k = 0; k < free.size(); ++k) {
                    (*fit.covariance)[free[j] * kCount + free[k]] = (*inverse)(j, k) * unit(free[j]) * unit(free[k]);
                }
            }
        }
    }
    const double step = fit.threshold_sd().value_or(0.1);
    fit.threshold_ci95 = {profile_end(likelihood, best, kChiSquare95, -1, std::clamp(step, 1e-4, 1.0)),
                          profile_end(likelihood, best, kChiSquare95, +1, std::clamp(step, 1e-4, 1.0))};

    if (fit.at_bound[0]) {
        fit.reason = "the threshold is at the end of its range: answers don't get better with strength";
    } else if (likelihood.is_at_upper_bound(best.theta, 1)) {
        fit.reason =
            "the slope is at its upper bound: a step explains the answers best, and may lie anywhere between two "
            "strengths";
    } else if (fit.at_bound[1]) {
        fit.reason = "the slope is at its lower bound: answers hardly get better with strength";
    } else if (!fit.converged || !fit.covariance) {
        fit.reason = "no clear maximum: a range of thresholds and slopes explains the answers equally well";
    } else if (!std::isfinite(fit.threshold_ci95.first) || !std::isfinite(fit.threshold_ci95.second)) {
        fit.reason = std::isfinite(fit.threshold_ci95.second)  ? "the threshold is bounded above alone"
                     : std::isfinite(fit.threshold_ci95.first) ? "the threshold is bounded below alone"
                                                               : "the threshold is bounded on neither side";
    }
    return fit;
}

std::optional<Refit> refit_from(const PsychometricFit& fit, const std::vector<Level>& levels) {
    if (!fit.estimated || levels.empty()) return std::nullopt;
    const PsychometricLikelihood likelihood(levels, fit.settings);
    const PsychometricVector start = likelihood.theta_of(fit.parameters);
    const LikelihoodOptimum optimum = climb(likelihood, start, likelihood.not_fixed());
    if (!std::isfinite(optimum.value)) return std::nullopt;
    Refit refit;
    refit.parameters = likelihood.parameters(optimum.theta);
    refit.parameters.threshold += likelihood.middle();
    refit.log_likelihood = optimum.value;
    const double z_p = sigmoid_at_threshold(fit.settings.sigmoid, fit.settings.p_threshold, refit.parameters);
    for (const Level& level : levels) {
        const double residual =
            deviance_residual(level, probability_wrong(fit.settings.sigmoid, refit.parameters, z_p, level.strength));
        refit.deviance += residual * residual;
    }
    return refit;
}

std::array<double, kPsychometricParameters> score(const PsychometricFit& fit, const Answer01& answer) {
    const std::vector<Level> level{{answer.strength, answer.correct ? 1.0 : 0.0, 1}};
    const PsychometricLikelihood likelihood(level, fit.settings);
    const PsychometricVector theta = likelihood.theta_of(fit.parameters);
    PsychometricVector gradient{};
    double value;
    if (!likelihood.evaluate(theta, value, &gradient)) return {};
    gradient[1] /= fit.parameters.slope;
    return gradient;
}

}  // namespace stairstep
