#include "analysis/observer_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "analysis/ceres_options.h"
#include "analysis/robust_mean.h"

namespace stairstep {
namespace {

/// Lengths are measured in px of these, so that parameters are of order 1 for any texel size.
struct Scale {
    /// Geometric mean of the sizes.
    double texel_px = 1;
    /// Smallest size: where an intercept matters most.
    double intercept_px = 1;
};

/// How far the law is from one threshold, in standard deviations of its logarithm.
struct LawResidual {
    double texel_px;
    double ln_radius;
    double ln_radius_sd;
    Scale scale;

    /// ln c, b in smallest texels, p.
    template <typename T>
    bool operator()(const T* ln_slope, const T* intercept, const T* exponent, T* residual) const {
        const T radius = filter_radius(
            T(texel_px / scale.texel_px),
            LawParameters<T>{exp(*ln_slope), *intercept * (scale.intercept_px / scale.texel_px), *exponent});
        if (!(radius > T(0))) return false;  // no step may lead there
        *residual = (log(radius * scale.texel_px) - ln_radius) / ln_radius_sd;
        return true;
    }
};

enum class FreeParameter { none, intercept, exponent };

double residual_at(const Threshold& t, const LawParameters<double>& law) {
    return std::log(filter_radius(t.condition.texel_px, law) / t.radius_px()) / t.ln_radius_sd();
}

double weight_at(const Threshold& t, const LawParameters<double>& law, bool robust) {
    const double z = std::abs(residual_at(t, law));
    return robust && z > kHuberBound ? kHuberBound / z : 1;
}

std::optional<LawParameters<double>> fit(const std::vector<Threshold>& thresholds, FreeParameter free, bool robust) {
    double ln_scale = 0;
    double ln_slope = 0;
    Scale scale{1, thresholds.front().condition.texel_px};
    for (const Threshold& t : thresholds) {
        ln_scale += std::log(t.condition.texel_px) / thresholds.size();
        ln_slope += std::log(t.radius_px() / t.condition.texel_px) / thresholds.size();
        scale.intercept_px = std::min(scale.intercept_px, t.condition.texel_px);
    }
    scale.texel_px = std::exp(ln_scale);
    double intercept = 0;
    double exponent = 1;

    ceres::Problem problem;
    for (const Threshold& t : thresholds) {
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LawResidual, 1, 1, 1, 1>(new LawResidual{
                                     t.condition.texel_px, std::log(t.radius_px()), t.ln_radius_sd(), scale}),
                                 robust ? new ceres::HuberLoss(kHuberBound) : nullptr, &ln_slope, &intercept,
                                 &exponent);
    }
    if (free != FreeParameter::intercept) problem.SetParameterBlockConstant(&intercept);
    if (free != FreeParameter::exponent) problem.SetParameterBlockConstant(&exponent);

    ceres::Solver::Options options = least_squares_options(1e12);
    options.max_num_consecutive_invalid_steps =
        50;  // from so large a radius, steps to a negative r take a while to shrink
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable() || summary.termination_type != ceres::CONVERGENCE) return std::nullopt;

    // Back from scaled lengths: r = b + e^l·s^{1−p}·a^p.
    const LawParameters<double> law{std::exp(ln_slope) * std::pow(scale.texel_px, 1 - exponent),
                                    intercept * scale.intercept_px, exponent};
    if (!std::isfinite(law.slope) || !(law.slope > 0) || !std::isfinite(law.intercept)) return std::nullopt;
    return law;
}

/// The standard error of the parameter beside the slope: the element of (JᵀJ)⁻¹ that is its own.
double form_se(const std::vector<Threshold>& thresholds, const LawParameters<double>& law, FreeParameter free,
               bool robust) {
    double weights = 0;
    double mean_slope_derivative = 0;
    double mean_derivative = 0;
    std::vector<std::array<double, 3>> rows;  // w, ∂/∂ln c, ∂/∂parameter, both in SD
    for (const Threshold& t : thresholds) {
        const double radius = filter_radius(t.condition.texel_px, law);
        const double by_slope = (radius - law.intercept) / radius;
        const double by_parameter = free == FreeParameter::intercept
                                        ? 1 / radius
                                        : std::log(t.condition.texel_px / thresholds.front().condition.texel_px);
        const double w = weight_at(t, law, robust) / (t.ln_radius_sd() * t.ln_radius_sd());
        rows.push_back({w, by_slope, by_parameter});
        weights += w * by_slope * by_slope;
        mean_slope_derivative += w * by_slope * by_parameter;
        mean_derivative += w * by_parameter * by_parameter;
    }
    // What of the parameter's column the slope's doesn't explain.
    const double explained = mean_slope_derivative / weights;
    double left = 0;
    for (const auto& [w, by_slope, by_parameter] : rows) {
        left += w * (by_parameter - explained * by_slope) * (by_parameter - explained * by_slope);
    }
    return left > 0 ? 1 / std::sqrt(left) : INFINITY;
}

std::optional<ObserverForm> fit_form(const std::vector<Threshold>& thresholds, FreeParameter free, bool robust) {
    const auto law = fit(thresholds, free, robust);
    if (!law) return std::nullopt;
    const double se = form_se(thresholds, *law, free, robust);
    if (!std::isfinite(se)) return std::nullopt;
    return ObserverForm{*law, se};
}

bool has_two_sizes(const std::vector<Threshold>& thresholds) {
    return std::any_of(thresholds.begin(), thresholds.end(), [&](const Threshold& t) {
        return t.condition.texel_px != thresholds.front().condition.texel_px;
    });
}

}  // namespace

Effect ObserverLaw::ln_slope() const {
    return {std::log(through_origin.slope), ln_slope_se};
}

std::optional<ObserverLaw> fit_observer(const std::vector<Threshold>& thresholds, bool robust) {
    if (thresholds.empty()) return std::nullopt;
    const auto through_origin = fit(thresholds, FreeParameter::none, robust);
    if (!through_origin) return std::nullopt;
    ObserverLaw law;
    law.through_origin = *through_origin;
    double precision = 0;
    for (const Threshold& t : thresholds) {
        law.weight.push_back(weight_at(t, *through_origin, robust));
        precision += law.weight.back() / (t.ln_radius_sd() * t.ln_radius_sd());
    }
    law.linear_slope = linear_slope(thresholds);
    law.ln_slope_se = 1 / std::sqrt(precision);
    if (has_two_sizes(thresholds)) {
        law.with_intercept = fit_form(thresholds, FreeParameter::intercept, robust);
        law.with_exponent = fit_form(thresholds, FreeParameter::exponent, robust);
    }
    return law;
}

double linear_slope(const std::vector<Threshold>& thresholds) {
    assert(!thresholds.empty());
    double weights = 0;
    double sum = 0;
    for (const Threshold& t : thresholds) {
        // Σ a·r/sd² over Σ a²/sd² with sd ∝ a·s: a mean of r/a.
        const double w = 1 / (t.ln_radius_sd() * t.ln_radius_sd());
        weights += w;
        sum += w * t.radius_px() / t.condition.texel_px;
    }
    return sum / weights;
}

std::optional<ObserverSlope> observer_slope(const std::vector<Threshold>& thresholds) {
    const auto effect = fit_ln_slope(thresholds);
    if (!effect) return std::nullopt;
    ObserverSlope slope{thresholds.front().observer, effect->value, effect->se, linear_slope(thresholds), 0, 0};
    for (const Threshold& t : thresholds) slope.trials += t.trials;
    return slope;
}

std::optional<Effect> fit_ln_slope(const std::vector<Threshold>& thresholds, bool robust) {
    if (thresholds.empty()) return std::nullopt;
    if (!robust) {
        double precision = 0;
        double sum = 0;
        for (const Threshold& t : thresholds) {
            const double w = 1 / (t.ln_radius_sd() * t.ln_radius_sd());
            precision += w;
            sum += w * -std::numbers::ln10 * t.log_threshold;
        }
        return Effect{sum / precision, 1 / std::sqrt(precision)};
    }
    const auto law = fit(thresholds, FreeParameter::none, robust);
    if (!law) return std::nullopt;
    double precision = 0;
    for (const Threshold& t : thresholds) {
        precision += weight_at(t, *law, robust) / (t.ln_radius_sd() * t.ln_radius_sd());
    }
    return Effect{std::log(law->slope), 1 / std::sqrt(precision)};
}

}  // namespace stairstep
