#include "analysis/statistics.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <numeric>

namespace stairstep {

MeanEstimate mean_with_interval(const std::vector<double>& values) {
    assert(values.size() >= 2);
    const double n = static_cast<double>(values.size());
    MeanEstimate estimate;
    estimate.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0;
    for (const double value : values) squares += (value - estimate.mean) * (value - estimate.mean);
    estimate.sd = std::sqrt(squares / (n - 1));
    const double half_width = t_quantile(0.975, n - 1) * estimate.sd / std::sqrt(n);
    estimate.ci95 = {estimate.mean - half_width, estimate.mean + half_width};
    return estimate;
}

double t_quantile(double p, double degrees_of_freedom) {
    // In doubles throughout: good to 10⁻¹⁴, and bootstraps ask often.
    using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
    return boost::math::quantile(boost::math::students_t_distribution<double, Policy>(degrees_of_freedom), p);
}

double t_two_sided_p(double t, double degrees_of_freedom) {
    if (std::isinf(t)) return 0;
    return 2 * boost::math::cdf(boost::math::complement(boost::math::students_t(degrees_of_freedom), std::abs(t)));
}

double normal_cdf(double z) {
    return std::erfc(-z / std::sqrt(2.0)) / 2;
}

double normal_quantile(double p) {
    return boost::math::quantile(boost::math::normal(), p);
}

double quantile_of_sorted(std::span<const double> ascending, double p) {
    assert(!ascending.empty() && p >= 0 && p <= 1);
    const double position = p * static_cast<double>(ascending.size() - 1);
    const size_t below = static_cast<size_t>(position);
    if (below + 1 >= ascending.size()) return ascending.back();
    return ascending[below] + (position - static_cast<double>(below)) * (ascending[below + 1] - ascending[below]);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return quantile_of_sorted(values, 0.5);
}

std::vector<double> holm_adjusted(const std::vector<double>& p_values) {
    std::vector<size_t> order(p_values.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return p_values[a] < p_values[b]; });
    std::vector<double> adjusted(p_values.size());
    double largest = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        largest = std::max(largest, std::min(1.0, p_values[order[i]] * static_cast<double>(order.size() - i)));
        adjusted[order[i]] = largest;
    }
    return adjusted;
}

}  // namespace stairstep
