#include "analysis/condition_fit.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/random_effects.h"
#include "analysis/robust_mean.h"
#include "analysis/statistics.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// Weights below are worth a warning of their own.
constexpr double kLowWeight = 0.5;
/// Weights that are worth fewer than this share of equal ones make intervals that trust them too narrow.
constexpr double kFewObservers = 0.5;
/// Half an interval of ln c below which what observers' shapes do to c, .01 to .02, is not small beside it.
constexpr double kNarrow = 0.07;
/// From how many observers on BCa's intervals are near what they say.
constexpr size_t kObserversForBca = 40;
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
    const RandomEffects intercept = estimate_random_effects(intercepts);
    const RandomEffects exponent = estimate_random_effects(exponents);
    law.intercept_px = intercept.mean;
    law.intercept_ci95 = sandwich_interval(intercepts, intercept).ci95;
    law.exponent = exponent.mean;
    law.exponent_ci95 = sandwich_interval(exponents, exponent).ci95;
    law.form_method = "random-effects means over " + std::to_string(intercepts.size()) +
                      " observers (REML); sandwich errors with Satterthwaite's t";
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
    for (size_t j = 0; j < weight.size(); ++j) law.observer_slopes[j].weight = weight[j];
    for (const DownWeighted& d : law.down_weighted) {
        if (d.weight >= kLowWeight) continue;
        warnings.push_back(text_of(condition.key) + ": observer " + d.observer +
                           (d.texel_px ? ", texel " + format_number(*d.texel_px) + " px" : "") + ": counts only " +
                           format_fixed(100 * d.weight, 0) + " %, being far from the rest");
    }
}

}  // namespace

std::string text_of(const ConditionKey& key) {
    return std::string(name(key.pattern)) + ", contrast " + format_number(key.contrast) + ", " +
           std::string(name(key.kernel));
}

std::string interval_warning(SlopeMethod method, const SlopeEstimate& estimate, const std::vector<double>& weights) {
    double squares = 0;
    for (const double w : weights) squares += w * w;
    const double n = static_cast<double>(weights.size());
    if (method != SlopeMethod::mean_t && method != SlopeMethod::linear_t && 1 / squares < kFewObservers * n) {
        return "few observers have most of the weight: " + format_number(n) + " count as " +
               format_fixed(1 / squares, 1) +
               (method == SlopeMethod::sandwich
                    ? "; the interval allows for that, but --method mean-t may be narrower"
                    : "; the interval may be too narrow, --method sandwich or mean-t doesn't trust weights");
    }
    if (method == SlopeMethod::bca && weights.size() < kObserversForBca) {
        return "bca with " + format_number(n) +
               " observers holds the slope less often than 95 %: in 84 % of studies with five, 89 % with ten, 91 % "
               "with "
               "twenty, as the bootstrap knows no n - 1; --method sandwich does";
    }
    const double half_width = std::log(estimate.ci95.second / estimate.ci95.first) / 2;
    if (half_width > 0 && half_width < kNarrow) {
        return "the interval is narrow, +-" + format_fixed(100 * half_width, 1) +
               " %: steepness and lapses unlike the usual can move c by 1 to 2 %, and intervals of that width then "
               "hold it "
               "in 92 "
               "to 95 % rather than 95 %";
    }
    return "";
}

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

ConditionLaw law_of(const FittedCondition& condition, SlopeMethod chosen, const BootstrapSettings& bootstrap,
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
        if (condition.data.robust && !has_robust_form(method)) continue;
        // The slowest, and told apart from its faster relative only by non-linearity: where it is asked for.
        if (method == SlopeMethod::thresholds && chosen != method) continue;
        law.estimates.push_back(slope_estimate(method, condition.data, bootstrap));
        if (method == chosen) {
            law.slope = law.estimates.back().value;
            law.slope_ci95 = law.estimates.back().ci95;
            law.slope_method = law.estimates.back().method;
            std::vector<double> weights;
            for (const ObserverSlope& o : law.observer_slopes) weights.push_back(o.weight);
            const std::string warning = interval_warning(chosen, law.estimates.back(), weights);
            if (!warning.empty()) warnings.push_back(text_of(condition.key) + ": " + warning);
        }
    }
    estimate_form(law, condition, warnings);
    leave_out(law, condition);
    return law;
}

}  // namespace stairstep
