#include "stimuli/random.h"

#include <bit>
#include <cmath>
#include <numbers>

namespace stairstep {
namespace {

uint64_t splitmix64(uint64_t& state) {
    uint64_t z = (state += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

}  // namespace

Random::Random(uint64_t seed) : seed_(seed) {
    for (uint64_t& word : state_) word = splitmix64(seed);
}

Random Random::stream(uint64_t part) const {
    // Both are mixed, and differently, so that part 1 of part 2 isn't part 2 of part 1.
    uint64_t own = seed_;
    uint64_t mixed = part;
    return Random(splitmix64(own) ^ splitmix64(mixed));
}

uint64_t Random::bits() {
    const uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = std::rotl(state_[3], 45);
    return result;
}

double Random::uniform() {
    return static_cast<double>(bits() >> 11) * 0x1p-53;
}

uint64_t Random::below(uint64_t count) {
    // Reject the few values that would favour small results.
    const uint64_t threshold = (0 - count) % count;
    for (;;) {
        if (const uint64_t value = bits(); value >= threshold) return value % count;
    }
}

double Random::normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
}

}  // namespace stairstep
