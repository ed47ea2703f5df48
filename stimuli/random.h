// Random numbers that are the same for the same seed on every machine: the generator and the distributions are
// ours, because the standard library's distributions differ between vendors.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

namespace stairstep {

/// xoshiro256++ (Blackman & Vigna 2019), seeded through SplitMix64. A value: copy it to branch a stream.
class Random {
  public:
    explicit Random(uint64_t seed);

    /// A stream of its own for a part of the work: the same (seed, part) always gives the same stream.
    Random stream(uint64_t part) const;

    uint64_t bits();
    /// Uniform on [0, 1), 53 bits.
    double uniform();
    /// Uniform on {0, …, count − 1} without bias; count ≥ 1.
    uint64_t below(uint64_t count);
    /// Standard normal (Box–Muller).
    double normal();

    template <typename T>
    void shuffle(std::span<T> values) {
        for (size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
    }

  private:
    uint64_t seed_;
    uint64_t state_[4];
};

}  // namespace stairstep
