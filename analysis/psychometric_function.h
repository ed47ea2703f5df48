// Psychometric functions of any sigmoid: what psychometric_fit fits and evaluates.
//
//   Ψ(x) = 1 − (1 − γ)·(δ + (1 − δ)·S(z)),   z = b·(x − T) + z_p,   Ψ(T) = p
//
// S falls from 1 to 0: Weibull in log units exp(−10^z), cumulative Gaussian Φ(−z), logistic 1/(1 + e^z); x and T log10 units,
// b > 0 the steepness in the sigmoid's own unit, γ guess rate, δ rate of answers given blindly (the lapse rate in the sense of
// an upper asymptote is δ·(1 − γ)). z_p solves (1 − γ)·(δ + (1 − δ)·S(z_p)) = 1 − p. The Weibull is study/psychometric.h's.
//
// Anchors: Ψ(T) = p for every sigmoid; b = 1, γ = δ = 0, p = ½: Gaussian Ψ(T + 1.959964) = .975, logistic Ψ(T + ln 3) = .75.
#pragma once

#include <ceres/jet.h>

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace stairstep {

enum class Sigmoid { weibull, gaussian, logistic };

template <typename T>
struct PsychometricParameters {
    /// T at p, log10 units.
    T threshold{};
    /// b.
    T slope{};
    /// δ in [0, 1) and γ in [0, 1).
    T lapse{};
    T guess{};
};

namespace sigmoid {

inline double value_of(double x) {
    return x;
}
template <typename T, int N>
double value_of(const ceres::Jet<T, N>& x) {
    return value_of(x.a);
}

/// z with Φ(−z) = s, for doubles and for Jets of them.
inline double gaussian_inverse(double s) {
    return std::numbers::sqrt2 * boost::math::erfc_inv(2 * s);
}
template <int N>
ceres::Jet<double, N> gaussian_inverse(const ceres::Jet<double, N>& s) {
    const double z = gaussian_inverse(s.a);
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
    return ceres::Jet<double, N>(z, -s.v / density);
}

/// Φ(−z).
inline double gaussian_survival(double z) {
    return std::erfc(z / std::numbers::sqrt2) / 2;
}
template <int N>
ceres::Jet<double, N> gaussian_survival(const ceres::Jet<double, N>& z) {
    const double density = std::exp(-z.a * z.a / 2) / std::sqrt(2 * std::numbers::pi);
    return ceres::Jet<double, N>(gaussian_survival(z.a), -density * z.v);
}

template <typename T>
T survival(Sigmoid sigmoid, const T& z) {
    using std::exp;
    // Beyond these S is 0 or 1 to all digits, and its derivatives are 0.
    if (sigmoid == Sigmoid::weibull) {
        if (value_of(z) > 2.8) return T(0.0);
        if (value_of(z) < -300) return T(1.0);
        return exp(-exp(z * std::numbers::ln10));
    }
    if (value_of(z) > 700) return T(0.0);
    if (value_of(z) < -700) return T(1.0);
    if (sigmoid == Sigmoid::gaussian) return gaussian_survival(z);
    return 1.0 / (1.0 + exp(z));
}

/// z with S(z) = s, s in (0, 1).
template <typename T>
T inverse_survival(Sigmoid sigmoid, const T& s) {
    using std::log;
    if (sigmoid == Sigmoid::weibull) return log(-log(s)) / std::numbers::ln10;
    if (sigmoid == Sigmoid::gaussian) return gaussian_inverse(s);
    return log(1.0 / s - 1.0);
}

}  // namespace sigmoid

/// z_p: needs γ < p < 1 − δ(1 − γ).
template <typename T>
T sigmoid_at_threshold(Sigmoid sigmoid, double p, const PsychometricParameters<T>& f) {
    return sigmoid::inverse_survival(sigmoid, ((1.0 - p) / (1.0 - f.guess) - f.lapse) / (1.0 - f.lapse));
}

/// 1 − Ψ(x), with all digits where it is small.
template <typename T>
T probability_wrong(Sigmoid sigmoid, const PsychometricParameters<T>& f, const T& z_p, double x) {
    const T s = sigmoid::survival(sigmoid, f.slope * (x - f.threshold) + z_p);
    return (1.0 - f.guess) * (f.lapse + (1.0 - f.lapse) * s);
}

}  // namespace stairstep
