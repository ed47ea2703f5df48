// Visibility: what share of the kernel's mass around a point sees the light.
//
//   V(p) = ∫ k_r(q)·χ(p + q) dq,   χ = 1 on and above the edge, 0 below
//
// A sampled edge is a staircase, so the integral is a sum over its columns; a line is a half-plane. In units of r and
// relative to p, with h a column's height and [b, e] its part under the kernel:
//
//   box       ½(e − b)·(1 − h)/2, h limited to [−1, 1]; the columns of step and stair add up in closed form, so the cost
//             depends neither on r nor on a. Line: the area of a square under a line.
//   gaussian  [Φ(e) − Φ(b)]·[1 − Φ(h)], Φ the cumulative normal of σ = ½, cut at ±1.5 and renormalised. Line: the same
//             product integrated along the line (Gauss–Legendre on smooth pieces; a level line needs none).
//   disk      area of {x² + y² ≤ 1, b ≤ x ≤ e, y ≥ h}/π, by S(x) = ½(x√(1 − x²) + asin x). Line: the circular segment
//             ½ + (d√(1 − d²) + asin d)/π at the distance d.
//   poisson   the sum over the taps.
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
    double box(const Edge& edge, Point p) const;
    double gaussian(const Edge& edge, Point p) const;
    double disk(const Edge& edge, Point p) const;
    double poisson(const Edge& edge, Point p, double rotation) const;

    Kernel kernel_;
    std::vector<KernelTap> taps_;
};

/// V at one point; `Filter` prepares less when there are many.
double visibility(const Edge& edge, const Kernel& kernel, Point p);

}  // namespace stairstep
