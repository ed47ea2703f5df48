// A straight edge under a kernel: how visibility rises across it.
//
// Along the line y = m·x nothing changes, so V is a function of one number, d = (y − m·x)/r. Box: the area of a square above
// a line. Disk: the circular segment. For the cut Gaussian the slope of V is in closed form,
//
//   dV/dd = ∫ φ(x)·φ(d − m·x) dx = s²·√(π/8q)·e^{−2d²/q}·[erf(√(2q)·(x₁ − m·d/q)) − erf(√(2q)·(x₀ − m·d/q))]
//
// with q = 1 + m², φ(x) = s·e^{−2x²} on |x| ≤ 1.5, and [x₀, x₁] where both factors are. It has kinks where the line passes a
// corner of the kernel's square, d = ±1.5(1 ± m); between them it is expanded in Chebyshev polynomials on short
// intervals and integrated term by term. V(d) + V(−d) = 1.
//
// The Gaussian's table takes as long as a thousand values; Filter::visibility, which needs none, integrates along the line
// instead, and the two agree within 10⁻¹³ (tests/stimuli/line_profile_test.cpp).
#pragma once

#include <array>
#include <vector>

#include "stimuli/edge.h"
#include "stimuli/kernel.h"

namespace stairstep {

class LineProfile {
  public:
    /// Whether there is one: for lines under box, disk or gaussian of a radius above 0, gaussian up to a slope of 20.
    static bool suits(const Edge& edge, const Kernel& kernel);

    /// The edge and kernel must suit.
    LineProfile(const Edge& line, const Kernel& kernel);

    /// V in [0, 1] at a point that lies `above_px` above the line, measured along y.
    double visibility(double above_px) const;

  private:
    static constexpr size_t kTerms = 14;
    /// V as Σ coefficients[k]·T_k(t), t from −1 to 1 along an interval of d.
    using Expansion = std::array<double, kTerms>;
    /// Equal intervals of d between two kinks.
    struct Stretch {
        double begin = 0;
        double end = 0;
        std::vector<Expansion> intervals;
    };

    void tabulate(Stretch& stretch, double v_at_begin) const;
    double gaussian(double d) const;

    KernelShape shape_;
    double radius_px_;
    double slope_;
    /// Of the gaussian: from where the line touches the kernel's square to the next kink, and on to d = 0.
    std::array<Stretch, 2> stretches_;
};

}  // namespace stairstep
