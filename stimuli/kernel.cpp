#include "stimuli/kernel.h"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

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

}  // namespace stairstep
