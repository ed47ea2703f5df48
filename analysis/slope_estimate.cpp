#include "analysis/slope_estimate.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "analysis/observer_fit.h"
#include "analysis/robust_mean.h"
#include "analysis/statistics.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

std::vector<Effect> effects_of(const std::vector<ObserverSlope>& observers) {
    std::vector<Effect> effects;
    for (const ObserverSlope& o : observers) effects.push_back({o.ln_slope, o.ln_slope_se});
    return effects;
}

double mean_of(std::span<const Effect> effects, bool robust) {
    return robust ? huber_mean(effects).mean : estimate_random_effects(effects).mean;
}

/// From ln c to c. Rounding must not push a value out of an interval that is a point.
SlopeEstimate on_ratio_scale(SlopeMethod method, double ln_value, const Interval& ln_interval,
                             const std::string& words) {
    SlopeEstimate estimate{std::string(name(method)), std::exp(ln_value), {}, words};
    estimate.ci95 = {std::min(estimate.value, std::exp(ln_interval.first)),
                     std::max(estimate.value, std::exp(ln_interval.second))};
    return estimate;
}

std::string replicates_text(const BootstrapSettings& settings) {
    return std::to_string(settings.replicates) + " replicates, seed " + std::to_string(settings.seed);
}

/// One observer's estimate as the model has it: a true value between observers, and what measuring adds.
double draw(Random& random, const RandomEffects& fit, double se) {
    const double truth = fit.mean + fit.tau * random.normal();
    return truth + se * random.normal();
}

SlopeEstimate parametric(const std::vector<Effect>& effects, const BootstrapSettings& settings) {
    const RandomEffects fit = fit_random_effects(effects);
    const auto simulate = [&](Random random) {
        std::vector<Effect> study = effects;
        for (Effect& e : study) e.value = draw(random, fit, e.se);
        const RandomEffects again = estimate_random_effects(study);
        return StudyEstimate{again.mean, again.se};
    };
    return on_ratio_scale(
        SlopeMethod::parametric, fit.mean, studentised_interval({fit.mean, fit.se}, simulate, settings),
        "random-effects mean of ln c (REML); studentised parametric bootstrap of observers' slopes, " +
            replicates_text(settings));
}

SlopeEstimate of_thresholds(const SlopeData& data, const std::vector<Effect>& effects,
                            const BootstrapSettings& settings) {
    assert(data.thresholds.size() == data.observers.size());
    const RandomEffects fit = fit_random_effects(effects);
    const auto simulate = [&](Random random) {
        std::vector<Effect> study;
        for (const std::vector<Threshold>& thresholds : data.thresholds) {
            const double ln_slope = draw(random, fit, 0);
            std::vector<Threshold> drawn = thresholds;
            for (Threshold& t : drawn) {
                t.log_threshold = -ln_slope / std::log(10.0) + t.log_threshold_sd * random.normal();
            }
            if (const auto effect = fit_ln_slope(drawn)) study.push_back(*effect);
        }
        if (study.size() < 2) return StudyEstimate{};
        const RandomEffects again = estimate_random_effects(study);
        return StudyEstimate{again.mean, again.se};
    };
    return on_ratio_scale(SlopeMethod::thresholds, fit.mean,
                          studentised_interval({fit.mean, fit.se}, simulate, settings),
                          "random-effects mean of ln c (REML); studentised parametric bootstrap of thresholds, each "
                          "observer's law fitted again, " +
                              replicates_text(settings));
}

SlopeEstimate resampled(const std::vector<Effect>& effects, bool robust, const BootstrapSettings& settings) {
    const auto statistic = [&](std::span<const size_t> indices) {
        std::vector<Effect> drawn;
        for (const size_t i : indices) drawn.push_back(effects[i]);
        return mean_of(drawn, robust);
    };
    const BcaInterval bca = bca_interval(effects.size(), statistic, 0.95, settings);
    return on_ratio_scale(SlopeMethod::bca, bca.estimate, bca.interval,
                          std::string(robust ? "Huber mean" : "random-effects mean (REML)") +
                              " of ln c; cluster bootstrap (observers resampled), bias-corrected and accelerated, " +
                              replicates_text(settings));
}

SlopeEstimate linear(const std::vector<ObserverSlope>& observers) {
    std::vector<double> slopes;
    for (const ObserverSlope& o : observers) slopes.push_back(o.linear_slope);
    const MeanEstimate mean = mean_with_interval(slopes);
    return {std::string(name(SlopeMethod::linear_t)), mean.mean, mean.ci95,
            "mean of observers' weighted least-squares slopes in pixels; Student's t"};
}

}  // namespace

std::string_view name(SlopeMethod method) {
    switch (method) {
        case SlopeMethod::sandwich: return "sandwich";
        case SlopeMethod::knapp_hartung: return "knapp-hartung";
        case SlopeMethod::mean_t: return "mean-t";
        case SlopeMethod::linear_t: return "linear-t";
        case SlopeMethod::profile: return "profile";
        case SlopeMethod::posterior: return "posterior";
        case SlopeMethod::parametric: return "parametric";
        case SlopeMethod::thresholds: return "thresholds";
        case SlopeMethod::bca: return "bca";
    }
    return "";
}

std::optional<SlopeMethod> slope_method_named(std::string_view text) {
    for (const SlopeMethod method : kSlopeMethods) {
        if (name(method) == text) return method;
    }
    return std::nullopt;
}

bool needs_bootstrap(SlopeMethod method) {
    return method == SlopeMethod::parametric || method == SlopeMethod::thresholds || method == SlopeMethod::bca;
}

bool has_robust_form(SlopeMethod method) {
    return method == SlopeMethod::sandwich || method == SlopeMethod::bca;
}

double mean_ln_slope(const std::vector<ObserverSlope>& observers, bool robust) {
    return mean_of(effects_of(observers), robust);
}

SlopeEstimate slope_estimate(SlopeMethod method, const SlopeData& data, const BootstrapSettings& settings) {
    assert(data.observers.size() >= 2);
    assert(!data.robust || has_robust_form(method));
    const std::vector<Effect> effects = effects_of(data.observers);
    switch (method) {
        case SlopeMethod::sandwich: {
            if (data.robust) {
                const RobustMean fit = huber_mean(effects);
                return on_ratio_scale(method, fit.mean, fit.ci95,
                                      "Huber mean of ln c over observers; sandwich error, Student's t");
            }
            const RandomEffects fit = estimate_random_effects(effects);
            const SandwichInterval interval = sandwich_interval(effects, fit);
            return on_ratio_scale(method, fit.mean, interval.ci95,
                                  "random-effects mean of ln c over observers (REML); sandwich error (CR2), t with " +
                                      format_fixed(interval.degrees_of_freedom, 1) + " degrees of freedom");
        }
        case SlopeMethod::knapp_hartung: {
            const RandomEffects fit = fit_random_effects(effects);
            return on_ratio_scale(method, fit.mean, fit.ci95,
                                  "random-effects mean of ln c over observers (REML); Knapp-Hartung t");
        }
        case SlopeMethod::mean_t: {
            std::vector<double> values;
            for (const Effect& e : effects) values.push_back(e.value);
            const MeanEstimate mean = mean_with_interval(values);
            return on_ratio_scale(method, mean.mean, mean.ci95, "mean of ln c over observers; Student's t");
        }
        case SlopeMethod::linear_t: return linear(data.observers);
        case SlopeMethod::profile: {
            const ProfileInterval profile = profile_likelihood(effects, profile_bound(effects.size()));
            return on_ratio_scale(method, profile.mean, profile.interval,
                                  "maximum-likelihood mean of ln c; profile likelihood, tau profiled out, bound n "
                                  "ln(1 + t^2/(n - 1))");
        }
        case SlopeMethod::posterior: {
            const Posterior posterior = random_effects_posterior(effects, kTauPriorScale);
            return on_ratio_scale(method, posterior.mean, posterior.mean_ci95,
                                  "posterior median of ln c; equal-tailed, mean flat, tau half-Cauchy with scale " +
                                      format_number(kTauPriorScale));
        }
        case SlopeMethod::parametric: return parametric(effects, settings);
        case SlopeMethod::thresholds: return of_thresholds(data, effects, settings);
        case SlopeMethod::bca: return resampled(effects, data.robust, settings);
    }
    return {};
}

}  // namespace stairstep
