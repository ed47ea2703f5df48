#include "stimuli/quarter_mass.h"

#include <algorithm>

namespace stairstep {
namespace {

/// Mass beyond x of a normal of σ = ½ cut at ±1.5 and renormalised; both its tails are exact.
double cut_normal_beyond(double x) {
    static const double kMass = std::erf(3 / std::numbers::sqrt2);
    return std::clamp((1 - std::erf(x * std::numbers::sqrt2) / kMass) / 2, 0.0, 1.0);
}

/// S(x), x limited to the unit disk.
double quarter_area(double x) {
    if (std::abs(x) >= 1) return std::copysign(std::numbers::pi / 4, x);
    return (x * std::sqrt(1 - x * x) + std::asin(x)) / 2;
}

}  // namespace

KernelCoordinate kernel_coordinate(KernelShape shape, double at) {
    switch (shape) {
        case KernelShape::disk: return {at, quarter_area(at)};
        case KernelShape::gaussian: return {at, cut_normal_beyond(at)};
        default: return {at, std::clamp((1 - at) / 2, 0.0, 1.0)};
    }
}

}  // namespace stairstep
