// Visibility: what share of the kernel's mass around a point sees the light.
//
//   V(p) = ∫ k_r(q)·χ(p + q) dq,   χ = 1 on and above the edge, 0 below
//
// Box kernel, in closed form. With x₀ = p.x − r, x₁ = p.x + r and the area between a level and the edge under it
//   R(t) = ∫_{x₀}^{x₁} max(0, t − h(x)) dx
// the lit area of the box is R(p.y + r) − R(p.y − r), because clamp(u, 0, 2r) = max(0, u) − max(0, u − 2r).
// As h never falls, R is a closed form (Edge::area_below): the cost depends neither on r nor on the texel size.
//
// Anchors (tests/stimuli/visibility_test.cpp): V = ½ on a line under every radius; a stair and its line differ by
// at most (a/r)²/32 for r ≥ a, a step and the horizontal line by at most a/(4r).
#pragma once

#include "stimuli/edge.h"
#include "stimuli/kernel.h"

namespace stairstep {

/// V at p, in [0, 1]. Absolute error below 1e-12. Radius 0 gives χ(p).
/// Throws InputError for a radius that is negative or not finite, or a kernel other than box.
double visibility(const Edge& edge, const Kernel& kernel, Point p);

}  // namespace stairstep
