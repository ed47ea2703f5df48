#include "analysis/study_check.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "analysis/statistics.h"
#include "stimuli/parallel.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

/// Trials a strength from which on a track's blocks can tell something of η.
constexpr double kTrialsInABlock = 3;

using ConditionKey = std::tuple<Pattern, double, KernelShape>;

ConditionKey key_of(const ConditionName& c) {
    return {c.pattern, c.contrast, c.kernel};
}

ConditionName name_of(const Condition& c) {
    return {c.pattern, c.contrast, c.kernel};
}

PsychometricFitSettings settings_at(double p_threshold) {
    PsychometricFitSettings settings;
    settings.p_threshold = p_threshold;
    return settings;
}

std::vector<ObserverCurve> curves_of(const std::vector<Trial>& trials, const Law& law) {
    std::map<std::pair<std::string, ConditionKey>, double> log_slopes;
    for (const ConditionLaw& c : law.conditions) {
        for (const ObserverSlope& o : c.observer_slopes) {
            log_slopes[{o.observer, {c.pattern, c.contrast, c.kernel}}] = o.ln_slope / std::numbers::ln10;
        }
    }
    std::vector<ObserverCurve> curves;
    std::map<std::pair<std::string, ConditionKey>, size_t> index;
    for (const Trial& trial : trials) {
        const ConditionName condition = name_of(trial.condition);
        const std::pair key{trial.observer, key_of(condition)};
        const auto [place, is_new] = index.try_emplace(key, curves.size());
        if (is_new) {
            curves.push_back({trial.observer, condition, {}, {}, std::nullopt, {}, std::nullopt});
            if (const auto found = log_slopes.find(key); found != log_slopes.end()) {
                curves.back().log_slope = found->second;
            }
        }
        ObserverCurve& curve = curves[place->second];
        curve.answers.push_back({trial.strength(), trial.correct()});
        curve.trials.push_back(trial);
    }
    return curves;
}

std::optional<PsychometricFit> aligned_fit(const std::vector<const ObserverCurve*>& curves, double p_threshold) {
    const std::vector<Answer01> answers = aligned_answers(curves);
    if (answers.empty()) return std::nullopt;
    return fit_psychometric(answers, settings_at(p_threshold));
}

/// The smaller of what there is.
void keep_least(std::optional<double>& least, double p) {
    least = least ? std::min(*least, p) : p;
}

std::vector<ObserverCheck> observer_checks(const std::vector<Trial>& trials, const std::vector<ObserverCurve>& curves,
                                           double p_threshold) {
    std::vector<ObserverCheck> checks;
    std::map<std::pair<std::string, Task>, std::vector<Trial>> by_observer;
    for (const Trial& trial : trials) {
        std::vector<Trial>& own = by_observer[{trial.observer, trial.task}];
        if (own.empty()) {
            ObserverCheck check;
            check.observer = trial.observer;
            check.task = trial.task;
            checks.push_back(check);
        }
        own.push_back(trial);
    }
    for (ObserverCheck& check : checks) {
        const std::vector<Trial>& own = by_observer[{check.observer, check.task}];
        check.trials = static_cast<int>(own.size());
        for (const Trial& trial : own) check.right += trial.correct();
        check.sensitivity = sensitivity(response_counts(own), check.task);
        std::vector<const ObserverCurve*> own_curves;
        for (const ObserverCurve& curve : curves) {
            if (curve.observer != check.observer) continue;
            own_curves.push_back(&curve);
            if (!curve.goodness) continue;
            keep_least(check.least_deviance_p, curve.goodness->deviance.p_value);
            keep_least(check.least_order_p, curve.goodness->residual_with_order.p_value);
            check.influential_trials += static_cast<int>(curve.goodness->influential.size());
        }
        check.aligned = aligned_fit(own_curves, p_threshold);
    }
    return checks;
}

void add_scatter(ConditionCheck& check, const ConditionLaw& law, const std::vector<Threshold>& thresholds) {
    for (const ObserverSlope& o : law.observer_slopes) {
        double chi2 = 0;
        int count = 0;
        for (const Threshold& t : thresholds) {
            if (!t.bounded || t.observer != o.observer || key_of(name_of(t.condition)) != key_of(check.condition)) {
                continue;
            }
            const double z = (std::log(t.radius_px()) - std::log(t.condition.texel_px) - o.ln_slope) / t.ln_radius_sd();
            chi2 += z * z;
            ++count;
        }
        if (count < 2) continue;
        check.scatter_chi2 += chi2;
        check.scatter_df += count - 1;
    }
    if (check.scatter_df > 0) check.scatter_p = chi2_upper_p(check.scatter_chi2, check.scatter_df);
}

/// Mean of η over the condition's tracks, if these are blocks.
std::optional<double> overdispersion_of(const std::vector<const ObserverCurve*>& curves, double p_threshold) {
    std::vector<Trial> trials;
    for (const ObserverCurve* curve : curves) {
        trials.insert(trials.end(), curve->trials.begin(), curve->trials.end());
    }
    double sum = 0;
    int tracks = 0;
    for (const Track& track : tracks_of(trials)) {
        std::set<double> strengths;
        for (const Trial& trial : track.trials) strengths.insert(trial.strength());
        const double repeats = static_cast<double>(track.trials.size()) / static_cast<double>(strengths.size());
        if (strengths.size() < 2 || repeats < kTrialsInABlock) continue;
        sum += fit_threshold(track, p_threshold, Answers::overdispersed).overdispersion;
        ++tracks;
    }
    if (tracks == 0) return std::nullopt;
    return sum / tracks;
}

}  // namespace

std::vector<Answer01> aligned_answers(const std::vector<const ObserverCurve*>& curves) {
    std::vector<Answer01> answers;
    for (const ObserverCurve* curve : curves) {
        if (!curve->log_slope) continue;
        for (const Answer01& a : curve->answers) answers.push_back({a.strength + *curve->log_slope, a.correct});
    }
    return answers;
}

double chi2_upper_p(double chi2, double df) {
    return boost::math::gamma_q(df / 2, chi2 / 2);
}

std::optional<double> fisher_combined(const std::vector<double>& p_values) {
    if (p_values.empty()) return std::nullopt;
    double chi2 = 0;
    for (const double p : p_values) chi2 -= 2 * std::log(p);
    return chi2_upper_p(chi2, 2.0 * static_cast<double>(p_values.size()));
}

std::optional<Interval> lapse_interval(const PsychometricFit& fit) {
    constexpr int kLapse = 2;
    if (!fit.estimated || !fit.covariance || fit.at_bound[kLapse]) return std::nullopt;
    const double variance = (*fit.covariance)[kLapse * kPsychometricParameters + kLapse];
    if (!(variance > 0)) return std::nullopt;
    const double half = normal_quantile(0.975) * std::sqrt(variance);
    return Interval{std::max(0.0, fit.parameters.lapse - half), std::min(1.0, fit.parameters.lapse + half)};
}

StudyCheck check_study(const std::vector<Trial>& trials, const LawFit& fit, const StudyCheckOptions& options) {
    StudyCheck check;
    check.simulations = options.simulations;
    check.seed = options.seed;
    const double p = fit.law.threshold_probability;
    check.curves = curves_of(trials, fit.law);
    const Random random(options.seed);
    run_in_parallel(check.curves.size(), options.jobs, [&](size_t i) {
        ObserverCurve& curve = check.curves[i];
        curve.fit = fit_psychometric(curve.answers, settings_at(p));
        if (!curve.fit.estimated || options.simulations == 0) return;
        curve.goodness = check_fit(curve.fit, curve.answers, options.simulations, random.stream(i).bits());
    });
    check.observers = observer_checks(trials, check.curves, p);

    check.conditions.resize(fit.law.conditions.size());
    run_in_parallel(check.conditions.size(), options.jobs, [&](size_t i) {
        const ConditionLaw& law = fit.law.conditions[i];
        ConditionCheck& c = check.conditions[i];
        c.condition = {law.pattern, law.contrast, law.kernel};
        std::vector<const ObserverCurve*> own;
        std::vector<double> deviance, prediction, order;
        for (const ObserverCurve& curve : check.curves) {
            if (key_of(curve.condition) != key_of(c.condition)) continue;
            own.push_back(&curve);
            if (!curve.goodness) continue;
            ++c.curves;
            deviance.push_back(curve.goodness->deviance.p_value);
            prediction.push_back(curve.goodness->residual_with_prediction.p_value);
            order.push_back(curve.goodness->residual_with_order.p_value);
        }
        c.aligned = aligned_fit(own, p);
        c.deviance_p = fisher_combined(deviance);
        c.prediction_p = fisher_combined(prediction);
        c.order_p = fisher_combined(order);
        add_scatter(c, law, fit.thresholds);
        c.overdispersion = overdispersion_of(own, p);
    });
    return check;
}

}  // namespace stairstep
