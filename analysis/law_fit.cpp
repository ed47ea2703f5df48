#include "analysis/law_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "analysis/comparison.h"
#include "analysis/robust_mean.h"
#include "analysis/statistics.h"
#include "analysis/worst_case.h"
#include "stimuli/error.h"
#include "stimuli/number.h"
#include "stimuli/parallel.h"

namespace stairstep {
namespace {

/// Weights below are worth a warning of their own.
constexpr double kLowWeight = 0.5;
/// Weights that are worth fewer than this share of equal ones make Knapp and Hartung's interval too narrow.
constexpr double kFewObservers = 0.5;
/// The criterion that texels are compared with: the study's own.
constexpr double kReferenceProbability = 0.82;

/// A law has one pattern, contrast and kernel.
struct ConditionKey {
    Pattern pattern;
    double contrast;
    KernelShape kernel;

    /// By pattern, then from full contrast down.
    bool operator<(const ConditionKey& other) const {
        return std::tuple(pattern, -contrast, kernel) < std::tuple(other.pattern, -other.contrast, other.kernel);
    }
};

std::string text_of(const ConditionKey& key) {
    return std::string(name(key.pattern)) + ", contrast " + format_number(key.contrast) + ", " +
           std::string(name(key.kernel));
}

using ThresholdsByObserver = std::map<std::string, std::vector<Threshold>>;

/// One condition between its thresholds and its law.
struct FittedCondition {
    ConditionKey key;
    std::vector<ObserverLaw> laws;
    SlopeData data;
};

FittedCondition fit_observers(const ConditionKey& key, const ThresholdsByObserver& observers, bool robust,
                              std::vector<std::string>& warnings) {
    FittedCondition condition{key, {}, {{}, {}, robust}};
    for (const auto& [observer, thresholds] : observers) {
        const auto law = fit_observer(thresholds, robust);
        if (!law) {
            warnings.push_back(text_of(key) + ": observer " + observer + " left out: the fit doesn't converge");
            continue;
        }
        ObserverSlope slope{observer, law->ln_slope().value, law->ln_slope_se, law->linear_slope, 0, 0};
        for (const Threshold& t : thresholds) slope.trials += t.trials;
        condition.data.observers.push_back(slope);
        condition.data.thresholds.push_back(thresholds);
        condition.laws.push_back(*law);
    }
    return condition;
}

/// Intercept and exponent over the observers who have them.
void estimate_form(ConditionLaw& law, const FittedCondition& condition, std::vector<std::string>& warnings) {
    std::vector<Effect> intercepts;
    std::vector<Effect> exponents;
    for (size_t j = 0; j < condition.laws.size(); ++j) {
        const ObserverLaw& o = condition.laws[j];
        if (o.with_intercept && o.with_exponent) {
            intercepts.push_back({o.with_intercept->parameters.intercept, o.with_intercept->se});
            exponents.push_back({o.with_exponent->parameters.exponent, o.with_exponent->se});
        } else {
            warnings.push_back(text_of(condition.key) + ": observer " + condition.data.observers[j].observer +
                               " counts for the slope alone: an intercept and an exponent need bounded thresholds at "
                               "two texel sizes");
        }
    }
    law.has_form = intercepts.size() >= 2;
    if (!law.has_form) {
        law.form_method = "not estimated: fewer than two observers have thresholds at two texel sizes";
        return;
    }
    const RandomEffects intercept = fit_random_effects(intercepts);
    const RandomEffects exponent = fit_random_effects(exponents);
    law.intercept_px = intercept.mean;
    law.intercept_ci95 = intercept.ci95;
    law.exponent = exponent.mean;
    law.exponent_ci95 = exponent.ci95;
    law.form_method =
        "random-effects means over " + std::to_string(intercepts.size()) + " observers (REML); Knapp-Hartung t";
}

void flag_largest(std::vector<LeftOut>& table) {
    const auto largest = std::max_element(table.begin(), table.end(), [](const LeftOut& a, const LeftOut& b) {
        return std::abs(std::log1p(a.change)) < std::abs(std::log1p(b.change));
    });
    if (largest != table.end() && largest->change != 0) largest->is_largest = true;
}

/// How far the mean of ln c moves without one observer, or one size.
void leave_out(ConditionLaw& law, const FittedCondition& condition) {
    const bool robust = condition.data.robust;
    const double all = mean_ln_slope(condition.data.observers, robust);
    const auto entry = [&](const std::string& left_out, const std::vector<ObserverSlope>& rest) {
        const double mean = mean_ln_slope(rest, robust);
        return LeftOut{left_out, std::exp(mean), std::expm1(mean - all), false};
    };
    for (size_t j = 0; j < condition.data.observers.size(); ++j) {
        std::vector<ObserverSlope> rest = condition.data.observers;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(j));
        law.without_observer.push_back(entry(condition.data.observers[j].observer, rest));
    }
    flag_largest(law.without_observer);

    std::set<double> sizes;
    for (const auto& thresholds : condition.data.thresholds) {
        for (const Threshold& t : thresholds) sizes.insert(t.condition.texel_px);
    }
    if (sizes.size() < 2) return;
    for (const double size : sizes) {
        std::vector<ObserverSlope> rest;
        for (size_t j = 0; j < condition.data.observers.size(); ++j) {
            std::vector<Threshold> thresholds = condition.data.thresholds[j];
            std::erase_if(thresholds, [&](const Threshold& t) { return t.condition.texel_px == size; });
            if (const auto effect = fit_ln_slope(thresholds, robust)) {
                rest.push_back({condition.data.observers[j].observer, effect->value, effect->se, 0, 0, 0});
            }
        }
        if (!rest.empty()) law.without_size.push_back(entry(format_number(size), rest));
    }
    flag_largest(law.without_size);
}

/// Names what a robust fit trusts less, and gives observers their weights.
void state_weights(ConditionLaw& law, const FittedCondition& condition, std::vector<std::string>& warnings) {
    std::vector<Effect> effects;
    for (const ObserverSlope& o : condition.data.observers) effects.push_back({o.ln_slope, o.ln_slope_se});
    const RandomEffects fit = fit_random_effects(effects);
    std::vector<double> weight = fit.weight;
    law.tau_ln = fit.tau;
    if (condition.data.robust) {
        const RobustMean robust = huber_mean(effects);
        law.tau_ln = robust.tau;
        double sum = 0;
        for (size_t j = 0; j < effects.size(); ++j) {
            const double variance = robust.tau * robust.tau + effects[j].se * effects[j].se;
            weight[j] = variance > 0 ? robust.weight[j] / variance : 1;
            sum += weight[j];
            if (robust.weight[j] < 1) {
                law.down_weighted.push_back({law.observer_slopes[j].observer, std::nullopt, robust.weight[j]});
            }
            for (size_t i = 0; i < condition.laws[j].weight.size(); ++i) {
                if (condition.laws[j].weight[i] == 1) continue;
                law.down_weighted.push_back({law.observer_slopes[j].observer,
                                             condition.data.thresholds[j][i].condition.texel_px,
                                             condition.laws[j].weight[i]});
            }
        }
        for (double& w : weight) w /= sum;
    }
    double squares = 0;
    for (size_t j = 0; j < weight.size(); ++j) {
        law.observer_slopes[j].weight = weight[j];
        squares += weight[j] * weight[j];
    }
    if (const double n = static_cast<double>(weight.size()); 1 / squares < kFewObservers * n) {
        warnings.push_back(text_of(condition.key) + ": few observers have most of the weight: " + format_number(n) +
                           " count as " + format_fixed(1 / squares, 1) +
                           "; the interval may be too narrow, --method mean-t doesn't depend on weights");
    }
    for (const DownWeighted& d : law.down_weighted) {
        if (d.weight >= kLowWeight) continue;
        warnings.push_back(text_of(condition.key) + ": observer " + d.observer +
                           (d.texel_px ? ", texel " + format_number(*d.texel_px) + " px" : "") + ": counts only " +
                           format_fixed(100 * d.weight, 0) + " %, being far from the rest");
    }
}

ConditionLaw law_of(const FittedCondition& condition, const LawFitOptions& options, const BootstrapSettings& bootstrap,
                    std::vector<std::string>& warnings) {
    ConditionLaw law;
    law.pattern = condition.key.pattern;
    law.contrast = condition.key.contrast;
    law.kernel = condition.key.kernel;
    law.observers = static_cast<int>(condition.data.observers.size());
    law.observer_slopes = condition.data.observers;
    std::vector<double> ln_slopes;
    for (const ObserverSlope& o : law.observer_slopes) {
        ln_slopes.push_back(o.ln_slope);
        law.trials += o.trials;
    }
    law.between_observer_sd_ln = mean_with_interval(ln_slopes).sd;
    state_weights(law, condition, warnings);

    for (const SlopeMethod method : kSlopeMethods) {
        if (needs_bootstrap(method) && bootstrap.replicates == 0) continue;
        if (options.robust && !has_robust_form(method)) continue;
        // The slowest, and told apart from its faster relative only by non-linearity: where it is asked for.
        if (method == SlopeMethod::thresholds && options.method != method) continue;
        law.estimates.push_back(slope_estimate(method, condition.data, bootstrap));
        if (method == options.method) {
            law.slope = law.estimates.back().value;
            law.slope_ci95 = law.estimates.back().ci95;
            law.slope_method = law.estimates.back().method;
        }
    }
    estimate_form(law, condition, warnings);
    leave_out(law, condition);
    return law;
}

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
                       (options.robust ? "Huber means" : "Knapp-Hartung t");
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
        throw InputError("--robust", "there is no robust form of " + method, "use --method knapp-hartung or bca");
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
        law.conditions.push_back(law_of(condition, options, bootstrap, result.warnings));
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
