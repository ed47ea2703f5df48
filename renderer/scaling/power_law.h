// How fast one thing grows with another: the exponent b of y = a·xᵇ.
//
// ln y = ln a + b·ln x, by least squares:
//
//   b = Σ (u − ū)(v − v̄) / Σ (u − ū)²      with u = ln x, v = ln y
//   se = √(Σ residual² / (n − 2) / Σ (u − ū)²)
//
// The standard error is right where residuals of v are independent and alike; it then makes t = (b − β)/se Student's, of n − 2
// degrees of freedom. What really bends (a constant plus a power) shows in it as well.
//
// x = 1, 2, 4 and y = 3, 12, 48 have b = 2, a = 3 and se = 0.
#pragma once

#include <optional>
#include <span>

namespace stairstep::scaling {

struct PowerLaw {
    double exponent = 0;
    /// nullopt for two points, which any power law meets.
    std::optional<double> exponent_se;
    /// y at x = 1.
    double factor = 1;
};

/// `x` and `y` have as many values, two or more. nullopt where one of them isn't finite and above 0, or all x are the same.
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

}  // namespace stairstep::scaling
