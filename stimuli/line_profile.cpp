#include "stimuli/line_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stimuli/quarter_mass.h"

namespace stairstep {
namespace {

constexpr double kCut = 1.5;
constexpr double kSteepest = 20;

/// Area of the square [−1, 1]² above the line y = m·x − d.
double square_above_line(double slope, double d) {
    // ∫ max(0, t − m·x) dx over [−1, 1], for the square's upper and lower side.
    const auto area_below = [slope](double level) {
        const double ramp = std::clamp(level + slope, 0.0, 2 * slope);
        return (slope > 0 ? ramp * ramp / (2 * slope) : 0) + 2 * std::max(0.0, level - slope);
    };
    return area_below(d + 1) - area_below(d - 1);
}

/// dV/dd of the cut Gaussian, see the header.
double gaussian_rise(double slope, double d) {
    static const double kPeak = std::sqrt(2 / std::numbers::pi) / std::erf(3 / std::numbers::sqrt2);
    const double q = 1 + slope * slope;
    const double x0 = std::max(-kCut, (d - kCut) / slope);
    const double x1 = std::min(kCut, (d + kCut) / slope);
    if (x1 <= x0) return 0;
    const double root = std::sqrt(2 * q);
    const double mass = std::erf(root * (x1 - slope * d / q)) - std::erf(root * (x0 - slope * d / q));
    return kPeak * kPeak * std::sqrt(std::numbers::pi / (8 * q)) * std::exp(-2 * d * d / q) * mass;
}

}  // namespace

bool LineProfile::suits(const Edge& edge, const Kernel& kernel) {
    if (edge.pattern() != Pattern::line || kernel.radius_px == 0) return false;
    if (kernel.shape == KernelShape::gaussian) return edge.slope() <= kSteepest;
    return kernel.shape != KernelShape::poisson;
}

LineProfile::LineProfile(const Edge& line, const Kernel& kernel)
    : shape_(kernel.shape), radius_px_(kernel.radius_px), slope_(line.slope()) {
    if (shape_ != KernelShape::gaussian || slope_ == 0) return;
    const double touch = -kCut * (1 + slope_);
    const double kink = -kCut * std::abs(1 - slope_);
    stretches_[0] = {touch, kink, {}};
    stretches_[1] = {kink, 0, {}};
    tabulate(stretches_[0], 0);
    double v_at_kink = 0;
    for (const double coefficient : stretches_[0].intervals.back()) v_at_kink += coefficient;  // T_k(1) = 1
    tabulate(stretches_[1], v_at_kink);
}

void LineProfile::tabulate(Stretch& stretch, double v_at_begin) const {
    // At most an eighth of a radius, or of the stretch, is short enough for the terms there are.
    const double length = stretch.end - stretch.begin;
    const auto count = static_cast<size_t>(std::max(12.0, std::ceil(8 * length)));
    const double half = length / static_cast<double>(count) / 2;
    for (size_t i = 0; i < count; ++i) {
        const double middle = stretch.begin + (2 * static_cast<double>(i) + 1) * half;
        // The rise at Chebyshev's nodes, its expansion, and the integral of that from the interval's begin.
        constexpr size_t kNodes = kTerms - 1;
        std::array<double, kNodes> rise;
        for (size_t j = 0; j < kNodes; ++j) {
            const double t = std::cos(std::numbers::pi * (static_cast<double>(j) + 0.5) / kNodes);
            rise[j] = gaussian_rise(slope_, middle + half * t);
        }
        std::array<double, kNodes + 2> c{};
        for (size_t k = 0; k < kNodes; ++k) {
            for (size_t j = 0; j < kNodes; ++j) {
                c[k] += rise[j] *
                        std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(j) + 0.5) / kNodes);
            }
            c[k] *= (k == 0 ? 1.0 : 2.0) / kNodes;
        }
        Expansion v{};
        double at_begin = 0;
        for (size_t k = 1; k < kTerms; ++k) {
            const double before = k == 1 ? 2 * c[0] : c[k - 1];
            v[k] = half * (before - c[k + 1 < c.size() ? k + 1 : c.size() - 1]) / (2 * static_cast<double>(k));
            at_begin += k % 2 == 0 ? v[k] : -v[k];
        }
        v[0] = v_at_begin - at_begin;
        stretch.intervals.push_back(v);
        v_at_begin = 0;
        for (const double coefficient : v) v_at_begin += coefficient;
    }
}

double LineProfile::gaussian(double d) const {
    if (slope_ == 0) return kernel_coordinate(shape_, -d).mass;
    if (d > 0) return 1 - gaussian(-d);
    if (d <= stretches_[0].begin) return 0;
    const Stretch& stretch = d <= stretches_[0].end ? stretches_[0] : stretches_[1];  // the latter may have no length
    const double count = static_cast<double>(stretch.intervals.size());
    const double along = (d - stretch.begin) / (stretch.end - stretch.begin) * count;
    const double interval = std::clamp(std::floor(along), 0.0, count - 1);
    const double t = 2 * (along - interval) - 1;
    const Expansion& v = stretch.intervals[static_cast<size_t>(interval)];
    // Clenshaw's recurrence.
    double b1 = 0;
    double b2 = 0;
    for (size_t k = kTerms - 1; k > 0; --k) {
        const double b = v[k] + 2 * t * b1 - b2;
        b2 = b1;
        b1 = b;
    }
    return v[0] + t * b1 - b2;
}

double LineProfile::visibility(double above_px) const {
    const double d = above_px / radius_px_;
    double v = 0;
    switch (shape_) {
        case KernelShape::box: v = square_above_line(slope_, d) / 4; break;
        case KernelShape::gaussian: v = gaussian(d); break;
        default: v = half_mass(shape_, kernel_coordinate(shape_, -d / std::sqrt(1 + slope_ * slope_)));
    }
    return std::clamp(v, 0.0, 1.0);
}

}  // namespace stairstep
