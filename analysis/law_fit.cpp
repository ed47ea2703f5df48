#include "analysis/law_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/comparison.h"
#include "analysis/condition_fit.h"
#include "analysis/robust_mean.h"
#include "analysis/statistics.h"
#include "analysis/worst_case.h"
#include "stimuli/error.h"
#include "stimuli/number.h"
#include "stimuli/parallel.h"

namespace stairstep {
namespace {

/// The criterion that texels are compared with: the study's own.
constexpr double kReferenceProbability = 0.82;

/// The top level of a law: its worst condition.
void state_worst_case(Law& law, const std::vector<FittedCondition>& conditions, const LawFitOptions& options) {
    const auto worst = std::max_element(law.conditions.begin(), law.conditions.end(),
                                        [](const auto& a, const auto& b) { return a.slope < b.slope; });
    law.kernel = worst->kernel;
    law.slope = worst->slope;
    law.pattern = worst->pattern;
    law.contrast = worst->contrast;

    std::vector<EffectsByObserver> effects;
    std::vector<ConditionMean> means;
    for (const FittedCondition& condition : conditions) {
        EffectsByObserver by_observer;
        std::vector<Effect> all;
        for (const ObserverSlope& o : condition.data.observers) {
            by_observer[o.observer] = {o.ln_slope, o.ln_slope_se};
            all.push_back(by_observer[o.observer]);
        }
        effects.push_back(by_observer);
        if (options.robust) {
            const RobustMean mean = huber_mean(all);
            means.push_back({mean.mean, mean.se});
        } else if (options.method != SlopeMethod::knapp_hartung) {
            // An error that gives the condition's own interval with worst_case's degrees of freedom: n − 1.
            const RandomEffects fit = estimate_random_effects(all);
            const Interval ci95 = sandwich_interval(all, fit).ci95;
            const double t = t_quantile(0.975, static_cast<double>(all.size()) - 1);
            means.push_back({fit.mean, (ci95.second - ci95.first) / 2 / t});
        }
    }
    if (law.conditions.size() == 1) {
        law.slope_ci95 = worst->slope_ci95;
        law.slope_method = worst->slope_method;
        return;
    }
    const WorstCase limits = worst_case(effects, options.bootstrap.seed, options.bootstrap.jobs, means);
    law.slope_ci95 = {std::min(law.slope, std::exp(limits.ci95.first)),
                      std::max(law.slope, std::exp(limits.ci95.second))};
    law.slope_method = "largest of " + std::to_string(law.conditions.size()) +
                       " conditions' slopes (each: " + worst->slope_method +
                       "); its interval, over all conditions: lower end simultaneous (max-t, critical value " +
                       format_fixed(limits.critical_value, 2) + "), upper end the largest of theirs, from " +
                       (options.robust                                 ? "Huber means"
                        : options.method == SlopeMethod::knapp_hartung ? "Knapp-Hartung t"
                                                                       : "sandwich errors with their t");
}

/// Why there is no law, for people.
std::string missing(const std::set<std::string>& observers, size_t thresholds) {
    if (thresholds == 0) return "there is no track of trials";
    if (observers.empty()) return "no observer's trials bound a threshold";
    if (observers.size() == 1) {
        return "only one observer (" + *observers.begin() + ") has thresholds, and an interval is between observers";
    }
    return "no condition has thresholds of two observers";
}

void require_consistent(const LawFitOptions& options) {
    const std::string method(name(options.method));
    if (needs_bootstrap(options.method) && options.bootstrap.replicates < 1) {
        throw InputError("--method " + method, "needs replicates", "use --bootstrap 2000");
    }
    if (options.robust && !has_robust_form(options.method)) {
        throw InputError("--robust", "there is no robust form of " + method, "use --method sandwich or bca");
    }
}

std::vector<Threshold> thresholds_of(const std::vector<Trial>& trials, double p_threshold, int jobs) {
    const std::vector<Track> tracks = tracks_of(trials);
    std::vector<Threshold> thresholds(tracks.size());
    run_in_parallel(tracks.size(), jobs, [&](size_t i) { thresholds[i] = fit_threshold(tracks[i], p_threshold); });
    return thresholds;
}

}  // namespace

LawFit fit_law_to_thresholds(std::vector<Threshold> thresholds, double p_threshold, const std::string& source,
                             const LawFitOptions& options) {
    require_consistent(options);
    LawFit result;
    result.thresholds = std::move(thresholds);
    std::map<ConditionKey, ThresholdsByObserver> by_condition;
    std::set<std::string> observers;
    for (const Threshold& threshold : result.thresholds) {
        const Condition& c = threshold.condition;
        const ConditionKey key{c.pattern, c.contrast, c.kernel};
        result.law.trials += threshold.trials;
        if (threshold.bounded) {
            by_condition[key][threshold.observer].push_back(threshold);
            observers.insert(threshold.observer);
        } else {
            result.warnings.push_back("observer " + threshold.observer + ", " + text_of(key) + ", texel " +
                                      format_number(c.texel_px) +
                                      " px: left out: its trials don't bound the threshold");
        }
    }
    Law& law = result.law;
    std::vector<FittedCondition> conditions;
    const Random random(options.bootstrap.seed);
    for (const auto& [key, by_observer] : by_condition) {
        FittedCondition condition = fit_observers(key, by_observer, options.robust, result.warnings);
        if (condition.data.observers.size() < 2) {
            result.warnings.push_back(text_of(key) + ": no law: an interval between observers needs two of them");
            continue;
        }
        BootstrapSettings bootstrap = options.bootstrap;
        bootstrap.seed = random.stream(law.conditions.size()).bits() >> 11;  // as JSON and people can hold it exactly
        law.conditions.push_back(law_of(condition, options.method, bootstrap, result.warnings));
        conditions.push_back(std::move(condition));
    }
    if (law.conditions.empty()) {
        throw FailureError(source,
                           "the law can't be estimated, because " + missing(observers, result.thresholds.size()),
                           "record more observers or trials");
    }
    state_worst_case(law, conditions, options);
    law.comparisons = paired_comparisons(law.conditions, result.warnings);
    law.threshold_probability = p_threshold;
    const auto [smallest, largest] = std::minmax_element(
        result.thresholds.begin(), result.thresholds.end(),
        [](const Threshold& a, const Threshold& b) { return a.condition.texel_px < b.condition.texel_px; });
    law.texel_range_px = {smallest->condition.texel_px, largest->condition.texel_px};
    law.observers = static_cast<int>(observers.size());
    law.source = source + "; thresholds: posterior mean, steepness and lapses summed out; " +
                 law.conditions.front().slope_method + (options.robust ? "; robust" : "") +
                 "; Stairstep " STAIRSTEP_VERSION;
    return result;
}

LawFit fit_law(const std::vector<Trial>& trials, double p_threshold, const std::string& source,
               const LawFitOptions& options) {
    return fit_law_to_thresholds(thresholds_of(trials, p_threshold, options.bootstrap.jobs), p_threshold, source,
                                 options);
}

std::vector<CriterionLaw> fit_criteria(const std::vector<Trial>& trials, const std::vector<double>& p_thresholds,
                                       const std::string& source, const LawFitOptions& options) {
    LawFitOptions plain = options;
    if (!needs_bootstrap(options.method)) plain.bootstrap.replicates = 0;
    std::vector<CriterionLaw> criteria;
    double reference = 0;
    for (const double p : p_thresholds) {
        const Law law = fit_law(trials, p, source, plain).law;
        criteria.push_back({p, law.slope, law.slope_ci95, {law.pattern, law.contrast, law.kernel}, 1, 1});
        if (p == kReferenceProbability) reference = law.slope;
    }
    if (reference == 0) reference = fit_law(trials, kReferenceProbability, source, plain).law.slope;
    for (CriterionLaw& c : criteria) {
        c.texels_across = c.slope / reference;
        c.texels_in_all = c.texels_across * c.texels_across;
    }
    return criteria;
}

}  // namespace stairstep
