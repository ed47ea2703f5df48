#include "analysis/goodness_of_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

/// In standard errors of the threshold: from when on one step says a trial is worth an exact look, and from when on it is named.
constexpr double kLookAt = 0.3;
constexpr double kInfluential = 0.5;
/// Deviance that an answer may bring along: χ² with one degree of freedom, .999.
constexpr double kUnlikely = 10.83;

struct Statistics {
    double deviance = 0;
    double with_prediction = 0;
    double with_order = 0;
};

Statistics statistics(Sigmoid sigmoid, double p, const PsychometricParameters<double>& f,
                      const std::vector<Answer01>& answers, const std::vector<Level>& levels) {
    const double z_p = sigmoid_at_threshold(sigmoid, p, f);
    const auto wrong = [&](double x) { return probability_wrong(sigmoid, f, z_p, x); };
    Statistics result;
    std::vector<double> residuals, predictions, order, residuals_in_order;
    for (const Level& level : levels) {
        residuals.push_back(deviance_residual(level, wrong(level.strength)));
        predictions.push_back(1 - wrong(level.strength));
        result.deviance += residuals.back() * residuals.back();
    }
    for (const Answer01& answer : answers) {
        order.push_back(static_cast<double>(order.size()));
        residuals_in_order.push_back(
            deviance_residual({answer.strength, answer.correct ? 1.0 : 0.0, 1}, wrong(answer.strength)));
    }
    result.with_prediction = correlation(residuals, predictions);
    result.with_order = correlation(residuals_in_order, order);
    return result;
}

std::vector<InfluentialTrial> influential_trials(const PsychometricFit& fit, const std::vector<Answer01>& answers) {
    std::vector<InfluentialTrial> found;
    const auto sd = fit.threshold_sd();
    if (!sd) return found;
    // Equal answers have equal influence: one exact fit for all of them.
    std::map<std::pair<double, bool>, std::optional<Refit>> refits;
    for (size_t i = 0; i < answers.size(); ++i) {
        const Answer01& answer = answers[i];
        const double psi = fit.probability(answer.strength);
        const double deviance = -2 * std::log(answer.correct ? psi : 1 - psi);
        if (std::abs(one_step_threshold_shift(fit, answer)) < kLookAt * *sd && !(deviance > kUnlikely)) continue;
        const auto [place, is_new] = refits.try_emplace({answer.strength, answer.correct});
        if (is_new) {
            std::vector<Level> rest = fit.levels;
            for (Level& level : rest) {
                if (level.strength != answer.strength) continue;
                level.trials -= 1;
                level.right -= answer.correct ? 1 : 0;
            }
            std::erase_if(rest, [](const Level& level) { return level.trials == 0; });
            place->second = refit_from(fit, rest);
        }
        if (!place->second) continue;
        const double shift = place->second->parameters.threshold - fit.parameters.threshold;
        const double drop = fit.deviance - place->second->deviance;
        if (std::abs(shift) >= kInfluential * *sd || drop > kUnlikely) found.push_back({i, shift, drop});
    }
    std::stable_sort(found.begin(), found.end(), [](const InfluentialTrial& a, const InfluentialTrial& b) {
        return std::abs(a.threshold_shift) > std::abs(b.threshold_shift);
    });
    return found;
}

}  // namespace

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    assert(a.size() == b.size());
    const double n = static_cast<double>(a.size());
    double mean_a = 0, mean_b = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        mean_a += a[i] / n;
        mean_b += b[i] / n;
    }
    double aa = 0, bb = 0, ab = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

double one_step_threshold_shift(const PsychometricFit& fit, const Answer01& answer) {
    if (!fit.covariance) return 0;
    const auto gradient = score(fit, answer);
    double shift = 0;
    for (int i = 0; i < kPsychometricParameters; ++i) shift -= (*fit.covariance)[i] * gradient[i];
    return std::isfinite(shift) ? shift : 0;
}

GoodnessOfFit check_fit(const PsychometricFit& fit, const std::vector<Answer01>& answers, int simulations,
                        uint64_t seed) {
    if (!fit.estimated) throw InputError("goodness of fit", "nothing was fitted: " + fit.reason, "record more trials");
    const Sigmoid sigmoid = fit.settings.sigmoid;
    const double p = fit.settings.p_threshold;
    const Statistics observed = statistics(sigmoid, p, fit.parameters, answers, fit.levels);
    GoodnessOfFit result;
    result.deviance.observed = observed.deviance;
    result.residual_with_prediction.observed = observed.with_prediction;
    result.residual_with_order.observed = observed.with_order;

    int deviance = 0, with_prediction = 0, with_order = 0;
    const Random random(seed);
    std::vector<Answer01> drawn = answers;
    for (int s = 0; s < simulations; ++s) {
        Random stream = random.stream(static_cast<uint64_t>(s));
        for (Answer01& answer : drawn) answer.correct = stream.uniform() < fit.probability(answer.strength);
        const std::vector<Level> levels = levels_of(drawn);
        const auto refit = refit_from(fit, levels);
        if (!refit) continue;
        const Statistics simulated = statistics(sigmoid, p, refit->parameters, drawn, levels);
        ++result.simulations;
        deviance += simulated.deviance >= observed.deviance;
        with_prediction += std::abs(simulated.with_prediction) >= std::abs(observed.with_prediction);
        with_order += std::abs(simulated.with_order) >= std::abs(observed.with_order);
    }
    const auto p_value = [&](int as_far) { return (1.0 + as_far) / (1.0 + result.simulations); };
    result.deviance.p_value = p_value(deviance);
    result.residual_with_prediction.p_value = p_value(with_prediction);
    result.residual_with_order.p_value = p_value(with_order);
    result.influential = influential_trials(fit, answers);
    return result;
}

}  // namespace stairstep
