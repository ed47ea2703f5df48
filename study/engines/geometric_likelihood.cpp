#include "study/engines/geometric_likelihood.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <numbers>

namespace stairstep {
namespace {

/// Two points at a time: what every 64-bit x86 and ARM has in one register. GCC and Clang know such types.
constexpr size_t kLanes = 2;
using Lanes [[gnu::vector_size(kLanes * sizeof(double))]] = double;
using Bits [[gnu::vector_size(kLanes * sizeof(double))]] = uint64_t;

/// (−1)^k/k! for k = 0, 1, …
constexpr auto kCoefficients = [] {
    std::array<double, 16> c{1};
    for (size_t k = 1; k < c.size(); ++k) c[k] = -c[k - 1] / static_cast<double>(k);
    return c;
}();

/// Σ c_k·x^(k − first), k = first … last.
template <size_t first, size_t last>
inline Lanes series(Lanes x) {
    if constexpr (first == last) {
        return Lanes{} + kCoefficients[last];
    } else {
        return kCoefficients[first] + x * series<first + 1, last>(x);
    }
}

/// e^{−u} = 2^{−k}·e^{−r}, k the whole number nearest to u/ln 2, so |r| ≤ 0.347.
struct Exponential {
    Lanes operator()(Lanes u) const {
        // Adding 1.5·2⁵² rounds to a whole number, and leaves it in the lowest bits.
        constexpr double kRounder = 0x1.8p52;
        constexpr double kLn2High = 0x1.62e42fefap-1;  // 37 bits, so that k·kLn2High is exact
        constexpr double kLn2Low = 0x1.cf79abc9e3b39p-40;
        const Lanes shifted = u * std::numbers::log2e + kRounder;
        const Lanes k = shifted - kRounder;
        const Lanes rest = (u - k * kLn2High) - k * kLn2Low;
        const Bits power = (uint64_t{1023} << 52) - (std::bit_cast<Bits>(shifted) << 52);
        return series<0, 13>(rest) * std::bit_cast<Lanes>(power);
    }
};

/// 1 − e^{−u} = −u·Σ (−1)^k/k!·u^{k − 1}, k from 1.
template <size_t terms>
struct Complement {
    Lanes operator()(Lanes u) const { return -u * series<1, terms>(u); }
};

template <typename Function>
void multiply(double* factor, GeometricSequence sequence, size_t begin, size_t end, double a, double b) {
    const Function function;
    size_t i = begin;
    for (; i + kLanes <= end; i += kLanes) {
        Lanes power, product;
        std::memcpy(&power, sequence.power + i, sizeof power);
        std::memcpy(&product, factor + i, sizeof product);
        product *= a + b * function(sequence.scale * power);
        std::memcpy(factor + i, &product, sizeof product);
    }
    if (i < end) factor[i] *= a + b * function(Lanes{} + sequence.scale * sequence.power[i])[0];
}

}  // namespace

void multiply_by_exponential(double* factor, GeometricSequence u, size_t begin, size_t end, double a, double b) {
    multiply<Exponential>(factor, u, begin, end, a, b);
}
void multiply_by_complement(double* factor, GeometricSequence u, size_t begin, size_t end, double a, double b) {
    multiply<Complement<10>>(factor, u, begin, end, a, b);
}
void multiply_by_small_complement(double* factor, GeometricSequence u, size_t begin, size_t end, double a, double b) {
    multiply<Complement<5>>(factor, u, begin, end, a, b);
}
void multiply_by_tiny_complement(double* factor, GeometricSequence u, size_t begin, size_t end, double a, double b) {
    multiply<Complement<3>>(factor, u, begin, end, a, b);
}

}  // namespace stairstep
