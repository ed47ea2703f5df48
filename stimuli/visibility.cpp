#include "stimuli/visibility.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "stimuli/error.h"
#include "stimuli/gauss_legendre.h"
#include "stimuli/line_profile.h"
#include "stimuli/number.h"
#include "stimuli/quarter_mass.h"
#include "stimuli/stair_area.h"

namespace stairstep {
namespace {

double cut_normal_density(double x) {
    static const double kScale = std::sqrt(2 / std::numbers::pi) / std::erf(3 / std::numbers::sqrt2);
    return kScale * std::exp(-2 * x * x);
}

/// Mass of the cut Gaussian below x.
double mass_below(double x) {
    return kernel_coordinate(KernelShape::gaussian, -x).mass;
}

/// Mass of the cut Gaussian above the line y = m·x − d: ∫ density(x)·[1 − Φ(m·x − d)] dx, in units of the radius.
double gaussian_above_line(double slope, double d) {
    static const QuadratureRule kRule = gauss_legendre(24, -1, 1);
    constexpr double kCut = 1.5;
    // Φ has kinks where its argument passes the cut; between them the integrand is smooth. Pieces of at most half a unit
    // along x, and of at most one unit along the line, make 24 nodes exact to rounding.
    double low = -kCut;
    double high = kCut;
    double lit = 0;
    if (slope > 0) {
        const double dark_from = (d + kCut) / slope;  // right of it the line passes above the kernel
        const double lit_until = (d - kCut) / slope;  // left of it, below
        high = std::clamp(dark_from, -kCut, kCut);
        low = std::clamp(lit_until, -kCut, kCut);
        lit = mass_below(low);
    } else {
        return mass_below(d);
    }
    const double length = high - low;
    const int pieces = static_cast<int>(std::ceil(std::max({1.0, length / 0.5, std::min(length * slope, 2 * kCut)})));
    for (int piece = 0; piece < pieces; ++piece) {
        const double begin = low + length * piece / pieces;
        const double half = length / pieces / 2;
        for (size_t i = 0; i < kRule.nodes.size(); ++i) {
            const double x = begin + half * (1 + kRule.nodes[i]);
            lit += half * kRule.weights[i] * cut_normal_density(x) * mass_below(d - slope * x);
        }
    }
    return lit;
}

}  // namespace

Filter::Filter(const Kernel& kernel) : kernel_(kernel) {
    if (!(kernel.radius_px >= 0) || !std::isfinite(kernel.radius_px)) {
        throw InputError("filter radius " + format_number(kernel.radius_px), "must be a finite number, 0 px or above",
                         "use for example 35");
    }
    if (kernel.shape == KernelShape::poisson) {
        if (kernel.taps < 1 || kernel.taps > kMostTaps) {
            throw InputError("poisson taps " + std::to_string(kernel.taps), "must be 1 to " + std::to_string(kMostTaps),
                             "use for example 25");
        }
        taps_ = poisson_taps(kernel.taps, kernel.seed);
    }
}

double Filter::visibility(const Edge& edge, Point p, double rotation) const {
    const double reach = support(kernel_.shape) * kernel_.radius_px;
    // Wholly lit or wholly dark kernels are the common case and come out exact.
    if (p.y - reach >= edge.height(p.x + reach)) return 1;
    if (kernel_.radius_px == 0 || p.y + reach < edge.height(p.x - reach)) return 0;
    p = edge.localised(p);
    if (kernel_.shape == KernelShape::poisson) return poisson(edge, p, rotation);
    const double v = edge.pattern() == Pattern::line ? line(edge, p) : staircase(edge, p);
    return std::clamp(v, 0.0, 1.0);
}

double Filter::line(const Edge& edge, Point p) const {
    if (kernel_.shape == KernelShape::gaussian) return gaussian_above_line(edge.slope(), p.y / kernel_.radius_px);
    return LineProfile(edge, kernel_).visibility(p.y);
}

double Filter::staircase(const Edge& edge, Point p) const {
    const double r = kernel_.radius_px;
    if (edge.pattern() == Pattern::stair && kernel_.shape == KernelShape::box) {
        const double a = edge.texel_px();
        const StairSpan span(edge, p.x - r, p.x + r);
        const double lit =
            stair_area(span, StairLevel(edge, p.y + r), a) - stair_area(span, StairLevel(edge, p.y - r), a);
        return lit / (4 * r * r);
    }
    const KernelShape shape = kernel_.shape;
    const double reach = support(shape) * r;
    const auto level = [&](double column) { return kernel_coordinate(shape, (edge.column_height(column) - p.y) / r); };
    double column = edge.column(p.x - reach);
    const double last = edge.column(p.x + reach);
    KernelCoordinate below = level(column);
    double lit = half_mass(shape, below);
    while (++column <= last) {
        const KernelCoordinate corner = kernel_coordinate(shape, (edge.column_begin(column) - p.x) / r);
        const KernelCoordinate above = level(column);
        lit -= corner_mass(shape, corner, below, above);
        below = above;
    }
    return lit;
}

double Filter::poisson(const Edge& edge, Point p, double rotation) const {
    const double c = std::cos(rotation) * kernel_.radius_px;
    const double s = std::sin(rotation) * kernel_.radius_px;
    int lit = 0;
    for (const KernelTap& tap : taps_) {
        const double x = p.x + c * tap.x - s * tap.y;
        const double y = p.y + s * tap.x + c * tap.y;
        lit += y >= edge.height(x);
    }
    return static_cast<double>(lit) / static_cast<double>(taps_.size());
}

double visibility(const Edge& edge, const Kernel& kernel, Point p) {
    return Filter(kernel).visibility(edge, p);
}

}  // namespace stairstep
