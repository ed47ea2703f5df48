#include "analysis/binomial_interval.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "analysis/statistics.h"

namespace stairstep {

std::pair<double, double> binomial_interval(double successes, double trials) {
    assert(trials > 0 && successes >= 0 && successes <= trials);
    const double z = normal_quantile(0.975);
    const double middle = (successes + z * z / 2) / (trials + z * z);
    const double half = z * std::sqrt(successes * (trials - successes) / trials + z * z / 4) / (trials + z * z);
    // The ends are exact where all answers are alike; rounding must not put them outside.
    return {successes == 0 ? 0 : std::max(0.0, middle - half), successes == trials ? 1 : std::min(1.0, middle + half)};
}

}  // namespace stairstep
