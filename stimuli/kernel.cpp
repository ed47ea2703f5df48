#include "stimuli/kernel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "stimuli/random.h"

namespace stairstep {
namespace {

constexpr std::array kShapes{KernelShape::box, KernelShape::disk, KernelShape::gaussian, KernelShape::poisson};

}  // namespace

std::string_view name(KernelShape shape) {
    switch (shape) {
        case KernelShape::box: return "box";
        case KernelShape::disk: return "disk";
        case KernelShape::gaussian: return "gaussian";
        case KernelShape::poisson: return "poisson";
    }
    return "";
}

std::optional<KernelShape> kernel_shape_named(std::string_view text) {
    for (const KernelShape shape : kShapes) {
        if (name(shape) == text) return shape;
    }
    return std::nullopt;
}

double axis_deviation(KernelShape shape) {
    switch (shape) {
        case KernelShape::box: return 1 / std::sqrt(3.0);
        case KernelShape::gaussian: {
            // A standard normal cut at ±c keeps the variance 1 − 2c·φ(c)/erf(c/√2); here c = 3.
            const double density = std::exp(-4.5) / std::sqrt(2 * std::numbers::pi);
            return 0.5 * std::sqrt(1 - 6 * density / std::erf(3 / std::numbers::sqrt2));
        }
        case KernelShape::disk:
        case KernelShape::poisson: return 0.5;
    }
    return 0;
}

double support(KernelShape shape) {
    return shape == KernelShape::gaussian ? 1.5 : 1;
}

std::vector<KernelTap> box_taps(int side) {
    assert(side >= 1);
    std::vector<KernelTap> taps;
    taps.reserve(static_cast<size_t>(side) * side);
    const float weight = 1.0f / static_cast<float>(side * side);
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            taps.push_back({(2.0f * column + 1) / side - 1, (2.0f * row + 1) / side - 1, weight});
        }
    }
    return taps;
}

std::vector<KernelTap> poisson_taps(int count, uint64_t seed) {
    assert(count >= 1 && count <= kMostTaps);
    // A hexagonal packing of `count` points of this distance would fill the disk: no set has a larger one.
    double distance = std::sqrt(2 * std::numbers::pi / (std::sqrt(3.0) * count));
    constexpr int kDartsPerTap = 200;
    Random random(seed);
    std::vector<KernelTap> taps;
    while (static_cast<int>(taps.size()) < count) {
        int darts = kDartsPerTap;
        while (darts > 0 && static_cast<int>(taps.size()) < count) {
            const auto x = static_cast<float>(2 * random.uniform() - 1);
            const auto y = static_cast<float>(2 * random.uniform() - 1);
            if (x * x + y * y > 1) continue;
            --darts;
            const bool is_free = std::none_of(taps.begin(), taps.end(), [&](const KernelTap& tap) {
                return (tap.x - x) * (tap.x - x) + (tap.y - y) * (tap.y - y) < distance * distance;
            });
            if (is_free) {
                taps.push_back({x, y, 1.0f / static_cast<float>(count)});
                darts = kDartsPerTap;
            }
        }
        distance *= 0.97;
    }
    return taps;
}

double rotation_at(int column, int row, uint64_t seed) {
    const auto place = static_cast<uint64_t>(static_cast<uint32_t>(column)) << 32 | static_cast<uint32_t>(row);
    return 2 * std::numbers::pi * Random(seed).stream(place).uniform();
}

}  // namespace stairstep
