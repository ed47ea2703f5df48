// The psychometric function: the probability of a correct answer against stimulus strength.
//
//   Ψ(x) = δγ + (1 − δ)·[1 − (1 − γ)·exp(−10^{β(x − T + ε)})]        (Watson & Pelli 1983; a Weibull in log units)
//
// x stimulus strength, log10; T threshold in the unit of x; β steepness; γ guess rate; δ lapse rate. ε makes Ψ(T) equal
// the threshold probability p_T exactly:
//
//   ε = log10(−ln[(1 − (p_T − δγ)/(1 − δ))/(1 − γ)])/β
//
// In the study x = log10(texel_px/radius_px): greater is easier to see, and the radius at threshold is
// texel_px·10^(−T). One formula for the QUEST engine, simulated observers and fits.
//
// Anchors: ε = 0.0571 for β 3.5, γ 0, δ 0, p_T = .795 (Harvey 1986); Ψ(T) = p_T.
#pragma once

#include <algorithm>
#include <cmath>

namespace stairstep {

struct PsychometricShape {
    /// Steepness, > 0.
    double beta = 3.5;
    /// Rate of correct answers without seeing anything, [0, 1).
    double gamma = 0.5;
    /// Rate of answers given blindly, [0, 1).
    double delta = 0.01;
    /// Probability that defines the threshold, between γ and 1 − δ(1 − γ).
    double p_threshold = 0.82;
};

/// Whether the fields lie in their ranges, so that ε is a finite number.
inline bool is_valid(const PsychometricShape& s) {
    return s.beta > 0 && std::isfinite(s.beta) && s.gamma >= 0 && s.gamma < 1 && s.delta >= 0 && s.delta < 1 &&
           s.p_threshold > s.gamma && s.p_threshold < 1 - s.delta * (1 - s.gamma);
}

/// ε of a valid shape.
inline double threshold_offset(const PsychometricShape& s) {
    const double not_seen = (1 - (s.p_threshold - s.delta * s.gamma) / (1 - s.delta)) / (1 - s.gamma);
    return std::log10(-std::log(not_seen)) / s.beta;
}

/// 10^{β(x − T + ε)}, held between 10⁻³⁰⁰ and 10³⁰⁰ so that it and its logarithm stay finite.
inline double weibull_exponent(const PsychometricShape& s, double offset, double strength, double threshold) {
    return std::pow(10.0, std::clamp(s.beta * (strength - threshold + offset), -300.0, 300.0));
}

/// Ψ of a right answer, 1 − Ψ of a wrong one, given u = 10^{β(x − T + ε)} ≥ 0: precise in both tails. Underflows to 0
/// where γ or δ is 0; log_likelihood does not.
inline double answer_probability(const PsychometricShape& s, double u, bool correct) {
    // Where guessing keeps Ψ well above 0, taking it from 1 loses nothing, and exp is twice as fast as expm1.
    if (correct && s.gamma < 0.1) return s.gamma + (1 - s.delta) * (1 - s.gamma) * -std::expm1(-u);
    const double wrong = (1 - s.gamma) * (s.delta + (1 - s.delta) * std::exp(-u));
    return correct ? 1 - wrong : wrong;
}

/// Ψ at `strength` for a threshold, both log10 units, with ε computed once by the caller. In
/// [γ, 1 − δ(1 − γ)], finite for any finite arguments.
inline double probability_correct(const PsychometricShape& s, double offset, double strength, double threshold) {
    return answer_probability(s, weibull_exponent(s, offset, strength, threshold), true);
}

/// ln Ψ of a right answer, ln(1 − Ψ) of a wrong one: precise in both tails and finite even where γ or δ is 0 and the
/// probability itself would underflow.
inline double log_likelihood(const PsychometricShape& s, double offset, double strength, double threshold,
                             bool correct) {
    const double u = weibull_exponent(s, offset, strength, threshold);
    if (!correct && s.delta == 0) return std::log1p(-s.gamma) - u;
    return std::log(answer_probability(s, u, correct));
}

}  // namespace stairstep
