#include "analysis/robust_mean.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "analysis/statistics.h"

namespace stairstep {
namespace {

RobustMean plain(std::span<const Effect> effects) {
    const RandomEffects fit = fit_random_effects(effects);
    return {fit.mean, fit.tau, fit.se, fit.ci95, std::vector<double>(effects.size(), 1.0)};
}

}  // namespace

RobustMean huber_mean(std::span<const Effect> effects) {
    assert(!effects.empty());
    if (effects.size() < 4) return plain(effects);
    std::vector<double> values;
    std::vector<double> variances;
    for (const Effect& e : effects) {
        values.push_back(e.value);
        variances.push_back(e.se * e.se);
    }
    const double middle = median(values);
    std::vector<double> deviations;
    for (const double value : values) deviations.push_back(std::abs(value - middle));
    const double spread = 1.4826 * median(deviations);  // the normal's standard deviation over its MAD
    if (!(spread > 0)) return plain(effects);
    const double tau_squared = std::max(0.0, spread * spread - median(variances));

    const auto sigma_of = [&](size_t j) { return std::sqrt(tau_squared + variances[j]); };
    if (*std::min_element(variances.begin(), variances.end()) + tau_squared <= 0) return plain(effects);
    RobustMean fit;
    fit.tau = std::sqrt(tau_squared);
    fit.mean = middle;
    fit.weight.assign(effects.size(), 1.0);
    for (int i = 0; i < 500; ++i) {
        double weights = 0;
        double sum = 0;
        for (size_t j = 0; j < values.size(); ++j) {
            const double z = std::abs(values[j] - fit.mean) / sigma_of(j);
            fit.weight[j] = z > kHuberBound ? kHuberBound / z : 1;
            const double w = fit.weight[j] / (sigma_of(j) * sigma_of(j));
            weights += w;
            sum += w * (values[j] - middle);
        }
        const double next = middle + sum / weights;
        const bool settled = std::abs(next - fit.mean) <= 1e-12 * spread;
        fit.mean = next;
        if (settled) break;
    }
    const double n = static_cast<double>(effects.size());
    double slope = 0;
    double squares = 0;
    int within = 0;
    for (size_t j = 0; j < values.size(); ++j) {
        const double psi = fit.weight[j] * (values[j] - fit.mean) / sigma_of(j);
        squares += psi * psi / (sigma_of(j) * sigma_of(j));
        if (fit.weight[j] < 1) continue;
        slope += 1 / (sigma_of(j) * sigma_of(j));
        ++within;
    }
    if (within < 2) return plain(effects);
    fit.se = std::sqrt(n / (n - 1) * squares) / slope;
    const double half_width = t_quantile(0.975, n - 1) * fit.se;
    fit.ci95 = {fit.mean - half_width, fit.mean + half_width};
    return fit;
}

}  // namespace stairstep
