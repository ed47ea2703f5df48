// Visibility: what share of the kernel's mass around a point sees the light.
//
//   V(p) = ∫ k_r(q)·χ(p + q) dq,   χ = 1 on and above the edge, 0 below
//
// A sampled edge is a staircase: the integral is a sum over its corners under the kernel (quarter_mass.h), in closed form
// for a stair under the box, where the cost depends neither on r nor on a. A line is a half-plane:
//
//   box       the area of a square above a line
//   gaussian  a cut normal in x times the cumulative one up to the line, integrated along it (Gauss–Legendre on smooth
//             pieces; a level line needs none)
//   disk      the circular segment ½ + (d√(1 − d²) + asin d)/π at the distance d
//
// poisson is the sum over its taps.
//
// Anchors (tests/stimuli/visibility_test.cpp): V = ½ on a line under every symmetric kernel; under the box a stair and its
// line differ by at most (a/r)²/32 for r ≥ a, a step and the horizontal line by a/(4r).
#pragma once

#include <vector>

#include "stimuli/edge.h"
#include "stimuli/kernel.h"

namespace stairstep {

/// A kernel, checked and prepared for many points.
class Filter {
  public:
    /// Throws InputError for a radius that is negative or not finite, or a number of taps out of range.
    explicit Filter(const Kernel& kernel);

    const Kernel& kernel() const { return kernel_; }

    /// V at p, in [0, 1]. Error below 1e-12 for box and gaussian, 1e-10 for disk; poisson is the sum itself. Radius 0 gives
    /// χ(p). `rotation` turns the taps of a poisson kernel, radians.
    double visibility(const Edge& edge, Point p, double rotation = 0) const;

  private:
    double line(const Edge& edge, Point p) const;
    double staircase(const Edge& edge, Point p) const;
    double poisson(const Edge& edge, Point p, double rotation) const;

    Kernel kernel_;
    std::vector<KernelTap> taps_;
};

/// V at one point; `Filter` prepares less when there are many.
double visibility(const Edge& edge, const Kernel& kernel, Point p);

}  // namespace stairstep
