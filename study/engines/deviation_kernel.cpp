#include "study/engines/deviation_kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace stairstep {
namespace {

/// Shares of a sum below e^−36 of its largest term are below its rounding.
constexpr double kNegligible = 36;
/// Below this a plain sum may have lost terms to underflow and is done again with logarithms.
constexpr double kSmallestPlainSum = 1e-250;

}  // namespace

DeviationKernel::DeviationKernel(double sd, double grain, size_t points)
    : sd_(sd), grain_(grain), mirrored_(2 * points - 1), log_weights_(points), log_row_mass_(points) {
    assert((sd == 0 || sd >= grain / 2) && grain > 0 && points > 0);
    for (size_t l = 0; l < points; ++l) {
        const double z = static_cast<double>(l) * grain / sd;
        log_weights_[l] = l == 0 ? 0 : sd == 0 ? -std::numeric_limits<double>::infinity() : -z * z / 2;
        mirrored_[points - 1 + l] = mirrored_[points - 1 - l] = std::exp(log_weights_[l]);
    }
    // Z_i holds the weights up to either end of the grid.
    std::vector<double> sums(points);
    double sum = 0;
    for (size_t l = 0; l < points; ++l) sums[l] = sum += weight(l);
    for (size_t i = 0; i < points; ++i) log_row_mass_[i] = std::log(sums[i] + sums[points - 1 - i] - 1);
}

size_t DeviationKernel::reach(double depth) const {
    const double distance = std::sqrt(2 * depth) * sd_ / grain_;
    return distance < static_cast<double>(points() - 1) ? static_cast<size_t>(distance) : points() - 1;
}

void DeviationKernel::log_given_law(std::span<const double> in, std::span<double> out) const {
    log_convolve(in, out);
    for (size_t i = 0; i < points(); ++i) out[i] -= log_row_mass_[i];
}

void DeviationKernel::log_given_track(std::span<const double> in, std::span<double> out) const {
    std::vector<double> shared(points());
    for (size_t i = 0; i < points(); ++i) shared[i] = in[i] - log_row_mass_[i];
    log_convolve(shared, out);
}

void DeviationKernel::log_convolve(std::span<const double> in, std::span<double> out) const {
    const size_t n = points();
    assert(in.size() == n && out.size() == n);
    if (sd_ == 0) {
        std::copy(in.begin(), in.end(), out.begin());
        return;
    }
    // A sum is at least as large as its own point's term, e^(lowest − highest) of the largest: weights below that by
    // e^−kNegligible and a factor for the number of points don't change it.
    const auto [lowest, highest] = std::minmax_element(in.begin(), in.end());
    const double largest = *highest;
    const size_t reached = reach(largest - *lowest + kNegligible + std::log(static_cast<double>(n)));

    // Plain sums, relative to the largest term. Distances run in the outer loop: the inner one is then a pass over
    // neighbours in memory without a chain of sums. Terms of 0 at both ends are left out.
    std::vector<double> terms(n);
    for (size_t i = 0; i < n; ++i) terms[i] = std::exp(in[i] - largest);
    const auto is_there = [](double term) { return term > 0; };
    const size_t first = std::find_if(terms.begin(), terms.end(), is_there) - terms.begin();
    const size_t last = terms.rend() - std::find_if(terms.rbegin(), terms.rend(), is_there) - 1;
    std::vector<double> sums = terms;
    for (size_t l = 1; l <= reached; ++l) {
        const double w = weight(l);
        if (w == 0) break;
        for (size_t j = std::max(first, l); j <= last; ++j) sums[j - l] += w * terms[j];
        for (size_t j = first; j <= last && j + l < n; ++j) sums[j + l] += w * terms[j];
    }

    for (size_t i = 0; i < n; ++i) {
        if (sums[i] > kSmallestPlainSum) {
            out[i] = largest + std::log(sums[i]);
            continue;
        }
        double top = in[i];
        for (size_t j = 0; j < n; ++j) top = std::max(top, log_weights_[j > i ? j - i : i - j] + in[j]);
        double sum = 0;
        for (size_t j = 0; j < n; ++j) {
            const double below_top = log_weights_[j > i ? j - i : i - j] + in[j] - top;
            if (below_top > -kNegligible - std::log(static_cast<double>(n))) sum += std::exp(below_top);
        }
        out[i] = top + std::log(sum);
    }
}

}  // namespace stairstep
