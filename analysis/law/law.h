// The law: how large a filter radius hides a shadow-map texel (Kreuzer 2017, eq. 5.1).
//
//   r = b + c·aᵖ        with b = 0 and p = 1, the law proper:  r = c·a
//
// r filter radius, a texel size on screen, both in px (or both in any other one unit, when b = 0 and p = 1).
// c is dimensionless: the radius in texels. One formula for all: the fits instantiate it with automatic derivatives,
// the renderer with double.
//
// Anchor: filter_radius(10, {3.47}) = 34.7.
#pragma once

#include <cmath>

namespace stairstep {

template <typename T>
struct LawParameters {
    /// c > 0, radius in texels.
    T slope;
    /// b, px.
    T intercept = T(0);
    /// p.
    T exponent = T(1);
};

/// r(a) for a texel size > 0. No shortcut for p = 1: automatic derivatives need the power, and pow(a, 1) is a exactly.
template <typename T>
T filter_radius(const T& texel, const LawParameters<T>& law) {
    using std::pow;
    return law.intercept + law.slope * pow(texel, law.exponent);
}

}  // namespace stairstep
