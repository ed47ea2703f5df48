// What one answer is expected to tell about a threshold, summed over a block of thresholds: the inner loop of choosing a
// stimulus, in floats and in arrays of constant length, which compilers turn into vector instructions of any machine.
//
// With m(T) the posterior of T, p(T, ν) its parts by nuisance ν, and Ψ the chance of a right answer,
//
//   a(T) = Σ_ν p(T, ν)·Ψ(T, ν),    right = Σ_T a(T),    given = Σ_T m(T)·h(a(T)/m(T)),    h(p) = −p·log₂p − (1 − p)·log₂(1 − p)
//
// and over all blocks the information is h(Σ right) − Σ given, bits (Watson 2017; QUEST+). Floats are enough to choose
// by: the sums are off by some 10⁻⁶ bits, a trial tells some 10⁻¹, and a stimulus that tells 10⁻⁶ bits less than the best
// is as good as the best. The posterior itself is kept in doubles elsewhere.
#pragma once

#include <array>
#include <cstddef>

namespace stairstep {

/// Thresholds in a block.
inline constexpr size_t kLane = 8;
using Lane = std::array<float, kLane>;

struct BlockInformation {
    float right = 0;
    float given_bits = 0;
};

/// `weights` are p(T, ν), a block a nuisance; `psi` the block's Ψ for the first nuisance, those of the next `stride` on.
/// `mass` is Σ_ν p(T, ν), `inverse_mass` 1/mass, or 0 where mass is 0. No value negative or subnormal.
BlockInformation block_information(const Lane& mass, const Lane& inverse_mass, const float* weights, const float* psi,
                                   size_t stride, size_t nuisances);

/// log₂ of numbers in (0, 1], within 7·10⁻⁷, and relatively so around 1; about −127 at 0.
Lane log2_of(const Lane& x);

}  // namespace stairstep
