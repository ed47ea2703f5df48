#include "analysis/statistics.h"

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
    const double t = boost::math::quantile(boost::math::students_t(n - 1), 0.975);
    const double half_width = t * estimate.sd / std::sqrt(n);
    estimate.ci95 = {estimate.mean - half_width, estimate.mean + half_width};
    return estimate;
}

}  // namespace stairstep
