#include "study/engines/geometric_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace stairstep {
namespace {

/// u from `least` to `most`, 1,001 of them with equal ratios, as scale·power[i].
struct Sequence {
    double scale = 0.37;
    std::vector<double> powers;
    Sequence(double least, double most) {
        for (int i = 0; i <= 1000; ++i) powers.push_back(least / scale * std::pow(most / least, i / 1000.0));
    }
    GeometricSequence view() const { return {scale, powers.data()}; }
    long double u(size_t i) const { return static_cast<long double>(scale * powers[i]); }
};

using Multiply = void (*)(double*, GeometricSequence, size_t, size_t, double, double);

double largest_relative_error(Multiply multiply, const Sequence& sequence, double a, double b,
                              long double (*exact)(long double)) {
    std::vector<double> factors(sequence.powers.size(), 0.5);
    multiply(factors.data(), sequence.view(), 0, factors.size(), a, b);
    double largest = 0;
    for (size_t i = 0; i < factors.size(); ++i) {
        const long double truth = 0.5L * (a + b * exact(sequence.u(i)));
        largest = std::max(largest, static_cast<double>(std::abs((factors[i] - truth) / truth)));
    }
    return largest;
}

TEST(GeometricLikelihood, IsExactToRounding) {
    const auto exponential = [](long double u) { return std::exp(-u); };
    const auto complement = [](long double u) { return -std::expm1(-u); };
    EXPECT_LT(largest_relative_error(multiply_by_exponential, {0.05, 700}, 0, 1, exponential), 1e-15);
    EXPECT_LT(largest_relative_error(multiply_by_exponential, {1e-9, 1}, 0, 1, exponential), 1e-15);
    EXPECT_LT(largest_relative_error(multiply_by_exponential, {0.05, 60}, 0.01, 0.99, exponential), 1e-15);
    EXPECT_LT(largest_relative_error(multiply_by_complement, {1e-9, 0.07}, 0, 1, complement), 1e-15);
    EXPECT_LT(largest_relative_error(multiply_by_small_complement, {1e-12, 1e-3}, 0, 1, complement), 1e-15);
    EXPECT_LT(largest_relative_error(multiply_by_tiny_complement, {1e-65, 1e-6}, 0, 1, complement), 1e-15);
    EXPECT_LT(largest_relative_error(multiply_by_complement, {1e-9, 0.07}, 0.5, 0.5, complement), 1e-15);
}

TEST(GeometricLikelihood, LeavesWhatLiesOutsideAlone) {
    const Sequence sequence(0.1, 1);
    for (const size_t begin : {0, 1, 7}) {
        for (const size_t end : {7, 8, 11}) {
            std::vector<double> factors(20, 1);
            multiply_by_exponential(factors.data(), sequence.view(), begin, end, 0, 1);
            for (size_t i = 0; i < factors.size(); ++i) EXPECT_EQ(factors[i] != 1, i >= begin && i < end) << i;
        }
    }
}

}  // namespace
}  // namespace stairstep
