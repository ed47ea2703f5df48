#include "renderer/scaling/power_law.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace stairstep::scaling {
namespace {

bool all_positive(std::span<const double> values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value) && value > 0; });
}

/// Logarithms, and their mean.
std::pair<std::vector<double>, double> logarithms_of(std::span<const double> values) {
    std::vector<double> logarithms;
    for (const double value : values) logarithms.push_back(std::log(value));
    const double mean =
        std::accumulate(logarithms.begin(), logarithms.end(), 0.0) / static_cast<double>(logarithms.size());
    return {logarithms, mean};
}

}  // namespace

std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y) {
    assert(x.size() == y.size() && x.size() >= 2);
    if (!all_positive(x) || !all_positive(y) || std::ranges::min(x) == std::ranges::max(x)) return std::nullopt;
    const auto [u, u_mean] = logarithms_of(x);
    const auto [v, v_mean] = logarithms_of(y);
    double spread = 0;
    double together = 0;
    for (size_t i = 0; i < u.size(); ++i) {
        spread += (u[i] - u_mean) * (u[i] - u_mean);
        together += (u[i] - u_mean) * (v[i] - v_mean);
    }
    PowerLaw law;
    law.exponent = together / spread;
    law.factor = std::exp(v_mean - law.exponent * u_mean);
    if (u.size() > 2) {
        double squares = 0;
        for (size_t i = 0; i < u.size(); ++i) {
            const double residual = (v[i] - v_mean) - law.exponent * (u[i] - u_mean);
            squares += residual * residual;
        }
        law.exponent_se = std::sqrt(squares / static_cast<double>(u.size() - 2) / spread);
    }
    return law;
}

}  // namespace stairstep::scaling
