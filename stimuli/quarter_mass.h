// How much of a kernel's mass lies in a quarter-plane {x ≥ u, y ≥ v}: what every staircase under a kernel is made of.
//
// A staircase with corners at u₁ < u₂ < …, where its height changes from vₖ₋₁ to vₖ, has the visibility
//
//   V = H(v₀) − Σₖ [Q(uₖ, vₖ₋₁) − Q(uₖ, vₖ)]        H(v) = Q(−∞, v), the mass above a level edge
//
// in units of the radius and relative to the kernel's centre. Box and Gaussian are products, Q(u, v) = H(u)·H(v), with
// H(u) = (1 − u)/2 and the cut cumulative normal. For the disk, S(x) = ∫₀ˣ √(1 − t²) dt = ½(x√(1 − x²) + asin x) gives
//
//   π·Q(u, v) = π/4 − S(u) − S(v) + u·v          where the corner lies within the disk,
//   π·H(u) = π/2 − 2·S(u),
//
// and outside it Q is nothing, one of the two segments, or what both leave. All of it needs one function of u and one of v:
// `KernelCoordinate` holds them, so that a picture computes them once a column and once a row.
//
// Anchors: Q(0, 0) = ¼ and H(0) = ½ for each of the three; the disk's H(½) = ⅓ − √3/(4π).
#pragma once

#include <cmath>
#include <numbers>

#include "stimuli/kernel.h"

namespace stairstep {

/// A coordinate relative to the kernel's centre, in units of its radius, and what the kernel makes of it.
struct KernelCoordinate {
    double at = 0;
    /// Box and Gaussian: H, the mass beyond it. Disk: S, within ±π/4.
    double mass = 0;
};

/// Of box, disk or gaussian. `at` may be infinite.
KernelCoordinate kernel_coordinate(KernelShape shape, double at);

/// H(v) in [0, 1].
inline double half_mass(KernelShape shape, KernelCoordinate v) {
    return shape == KernelShape::disk ? 0.5 - v.mass * (2 / std::numbers::pi) : v.mass;
}

/// Q(u, v₀) − Q(u, v₁): the mass right of u between two levels, v₀ ≤ v₁. Exactly 0 where both levels lie on one side of the
/// kernel.
inline double corner_mass(KernelShape shape, KernelCoordinate u, KernelCoordinate v0, KernelCoordinate v1) {
    if (shape != KernelShape::disk) return u.mass * (v0.mass - v1.mass);
    const auto area = [&u](KernelCoordinate v) {
        if (u.at * u.at + v.at * v.at < 1) return std::numbers::pi / 4 - u.mass - v.mass + u.at * v.at;
        if (u.at < 0) return v.at < 0 ? -2 * u.mass - 2 * v.mass : std::numbers::pi / 2 - 2 * v.mass;
        return v.at < 0 ? std::numbers::pi / 2 - 2 * u.mass : 0.0;
    };
    return (area(v0) - area(v1)) / std::numbers::pi;
}

}  // namespace stairstep
