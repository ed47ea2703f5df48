#include "study/engines/block_information.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace stairstep {
namespace {

inline Lane weighted_sum(const float* weights, const float* psi, size_t stride, size_t nuisances) {
    // Even and odd rows have sums of their own, which don't wait for each other.
    Lane even{};
    Lane odd{};
    size_t row = 0;
    for (; row + 2 <= nuisances; row += 2) {
        for (size_t k = 0; k < kLane; ++k) even[k] += weights[k] * psi[k];
        for (size_t k = 0; k < kLane; ++k) odd[k] += weights[kLane + k] * psi[stride + k];
        weights += 2 * kLane;
        psi += 2 * stride;
    }
    if (row < nuisances) {
        for (size_t k = 0; k < kLane; ++k) even[k] += weights[k] * psi[k];
    }
    for (size_t k = 0; k < kLane; ++k) even[k] += odd[k];
    return even;
}

inline Lane log2_lane(const Lane& x) {
    // x = 2^e·(1 + t) with 1 + t in [√½, √2); log₂(1 + t)/t is a polynomial through Chebyshev's seven nodes.
    Lane result;
    for (size_t k = 0; k < kLane; ++k) {
        const int32_t bits = std::bit_cast<int32_t>(x[k]);
        const int32_t exponent = (bits - 0x3f3504f3) >> 23;
        const float t = std::bit_cast<float>(bits - exponent * (1 << 23)) - 1;
        float p = 0.168186591f;
        p = p * t - 0.267963871f;
        p = p * t + 0.296119557f;
        p = p * t - 0.359524455f;
        p = p * t + 0.480613125f;
        p = p * t - 0.721360179f;
        p = p * t + 1.44269652f;
        result[k] = static_cast<float>(exponent) + p * t;
    }
    return result;
}

inline float sum_of(const Lane& x) {
    return ((x[0] + x[4]) + (x[1] + x[5])) + ((x[2] + x[6]) + (x[3] + x[7]));
}

}  // namespace

Lane log2_of(const Lane& x) {
    return log2_lane(x);
}

BlockInformation block_information(const Lane& mass, const Lane& inverse_mass, const float* weights, const float* psi,
                                   size_t stride, size_t nuisances) {
    const Lane a = weighted_sum(weights, psi, stride, nuisances);
    Lane p;
    Lane q;
    for (size_t k = 0; k < kLane; ++k) p[k] = std::min(a[k] * inverse_mass[k], 1.f);
    for (size_t k = 0; k < kLane; ++k) q[k] = 1 - p[k];
    const Lane log_p = log2_lane(p);
    const Lane log_q = log2_lane(q);
    Lane entropy;
    for (size_t k = 0; k < kLane; ++k) entropy[k] = -mass[k] * (p[k] * log_p[k] + q[k] * log_q[k]);
    return {sum_of(a), sum_of(entropy)};
}

}  // namespace stairstep
