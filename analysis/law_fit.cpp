#include "analysis/law_fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "analysis/statistics.h"
#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// How far the law is from one threshold, in standard deviations of its logarithm.
struct LawResidual {
    double texel_px;
    double ln_radius;
    double ln_radius_sd;
    /// Texel size that lengths are measured in, px.
    double scale_px;

    /// Parameters of order 1 for any texel size: ln c, b in texels, p.
    template <typename T>
    bool operator()(const T* ln_slope, const T* intercept_texels, const T* exponent, T* residual) const {
        const T radius =
            filter_radius(T(texel_px / scale_px), LawParameters<T>{exp(*ln_slope), *intercept_texels, *exponent});
        if (!(radius > T(0))) return false;  // no step may lead there
        *residual = (log(radius * scale_px) - ln_radius) / ln_radius_sd;
        return true;
    }
};

enum class FreeParameter { none, intercept, exponent };

std::optional<LawParameters<double>> fit(const std::vector<Threshold>& thresholds, FreeParameter free) {
    double ln_scale = 0;
    double ln_slope = 0;
    for (const Threshold& t : thresholds) {
        ln_scale += std::log(t.condition.texel_px) / thresholds.size();
        ln_slope += std::log(t.radius_px() / t.condition.texel_px) / thresholds.size();
    }
    const double scale_px = std::exp(ln_scale);
    double intercept_texels = 0;
    double exponent = 1;

    ceres::Problem problem;
    for (const Threshold& t : thresholds) {
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LawResidual, 1, 1, 1, 1>(new LawResidual{
                                     t.condition.texel_px, std::log(t.radius_px()), t.ln_radius_sd(), scale_px}),
                                 nullptr, &ln_slope, &intercept_texels, &exponent);
    }
    if (free != FreeParameter::intercept) problem.SetParameterBlockConstant(&intercept_texels);
    if (free != FreeParameter::exponent) problem.SetParameterBlockConstant(&exponent);

    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.initial_trust_region_radius = 1e12;  // one to three parameters of order 1: plain Gauss-Newton steps
    options.function_tolerance = 1e-18;
    options.gradient_tolerance = 1e-12;
    options.parameter_tolerance = 1e-12;
    options.max_num_iterations = 200;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable() || summary.termination_type != ceres::CONVERGENCE) return std::nullopt;

    // Back from scaled lengths: r = s·(b' + e^l·(a/s)^p) = s·b' + e^l·s^{1−p}·a^p.
    return LawParameters<double>{std::exp(ln_slope) * std::pow(scale_px, 1 - exponent), intercept_texels * scale_px,
                                 exponent};
}

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

std::string describe(const ConditionKey& key) {
    return std::string(name(key.pattern)) + ", contrast " + format_number(key.contrast) + ", " +
           std::string(name(key.kernel));
}

bool has_two_sizes(const std::vector<Threshold>& thresholds) {
    return std::any_of(thresholds.begin(), thresholds.end(), [&](const Threshold& t) {
        return t.condition.texel_px != thresholds.front().condition.texel_px;
    });
}

std::optional<ConditionLaw> fit_condition(const ConditionKey& key,
                                          const std::map<std::string, std::vector<Threshold>>& observers,
                                          std::vector<std::string>& warnings) {
    std::vector<double> ln_slopes;
    std::vector<double> intercepts_px;
    std::vector<double> exponents;
    ConditionLaw law;
    for (const auto& [observer, thresholds] : observers) {
        const auto fitted = has_two_sizes(thresholds) ? fit_observer(thresholds) : std::nullopt;
        if (!fitted) {
            warnings.push_back(describe(key) + ": observer " + observer +
                               " left out: needs bounded thresholds at two texel sizes");
            continue;
        }
        ln_slopes.push_back(std::log(fitted->through_origin.slope));
        intercepts_px.push_back(fitted->with_intercept.intercept);
        exponents.push_back(fitted->with_exponent.exponent);
        for (const Threshold& t : thresholds) law.trials += t.trials;
    }
    if (ln_slopes.size() < 2) {
        warnings.push_back(describe(key) + ": no law: an interval between observers needs two of them");
        return std::nullopt;
    }

    const MeanEstimate ln_slope = mean_with_interval(ln_slopes);
    const MeanEstimate intercept = mean_with_interval(intercepts_px);
    const MeanEstimate exponent = mean_with_interval(exponents);
    law.pattern = key.pattern;
    law.contrast = key.contrast;
    law.kernel = key.kernel;
    law.slope = std::exp(ln_slope.mean);
    law.slope_ci95 = {std::exp(ln_slope.ci95.first), std::exp(ln_slope.ci95.second)};
    law.intercept_px = intercept.mean;
    law.intercept_ci95 = intercept.ci95;
    law.exponent = exponent.mean;
    law.exponent_ci95 = exponent.ci95;
    law.between_observer_sd_ln = ln_slope.sd;
    law.observers = static_cast<int>(ln_slopes.size());
    return law;
}

/// The top level of a law: its worst condition.
void state_worst_case(Law& law) {
    const auto worst = std::max_element(law.conditions.begin(), law.conditions.end(),
                                        [](const auto& a, const auto& b) { return a.slope < b.slope; });
    law.kernel = worst->kernel;
    law.slope = worst->slope;
    law.slope_ci95 = worst->slope_ci95;
    law.pattern = worst->pattern;
    law.contrast = worst->contrast;
}

}  // namespace

std::optional<ObserverLaw> fit_observer(const std::vector<Threshold>& thresholds) {
    const auto through_origin = fit(thresholds, FreeParameter::none);
    const auto with_intercept = fit(thresholds, FreeParameter::intercept);
    const auto with_exponent = fit(thresholds, FreeParameter::exponent);
    if (!through_origin || !with_intercept || !with_exponent) return std::nullopt;
    return ObserverLaw{*through_origin, *with_intercept, *with_exponent};
}

LawFit fit_law(const std::vector<Trial>& trials, double p_threshold, const std::string& source) {
    LawFit result;
    std::map<ConditionKey, std::map<std::string, std::vector<Threshold>>> conditions;
    std::set<std::string> observers;
    for (const Track& track : tracks_of(trials)) {
        const Threshold threshold = fit_threshold(track, p_threshold);
        result.thresholds.push_back(threshold);
        const Condition& c = track.condition;
        auto& condition = conditions[{c.pattern, c.contrast, c.kernel}];
        if (threshold.bounded) {
            condition[track.observer].push_back(threshold);
            observers.insert(track.observer);
        } else {
            result.warnings.push_back(
                "observer " + track.observer + ", " + describe({c.pattern, c.contrast, c.kernel}) + ", texel " +
                format_number(c.texel_px) + " px: left out: its trials don't bound the threshold");
        }
    }
    for (const auto& [key, by_observer] : conditions) {
        if (const auto law = fit_condition(key, by_observer, result.warnings)) result.law.conditions.push_back(*law);
    }
    if (result.law.conditions.empty()) {
        throw FailureError(source,
                           "no law can be fitted: no condition has two observers with thresholds at two texel sizes",
                           "record more observers, sizes or trials");
    }

    Law& law = result.law;
    state_worst_case(law);
    law.threshold_probability = p_threshold;
    const auto [smallest, largest] =
        std::minmax_element(trials.begin(), trials.end(),
                            [](const Trial& a, const Trial& b) { return a.condition.texel_px < b.condition.texel_px; });
    law.texel_range_px = {smallest->condition.texel_px, largest->condition.texel_px};
    law.observers = static_cast<int>(observers.size());
    law.trials = static_cast<int>(trials.size());
    law.source =
        source +
        "; thresholds: posterior mean, steepness and lapses summed out; intervals: mean of ln c over observers "
        "with Student's t; intercept and exponent likewise; Stairstep " STAIRSTEP_VERSION;
    return result;
}

}  // namespace stairstep
