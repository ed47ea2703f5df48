#include "stimuli/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// Calls each(begin, end, height) for the parts of a staircase's columns within [x0, x1], all relative to p.
template <typename Each>
void for_each_column(const Edge& edge, Point p, double x0, double x1, const Each& each) {
    const double last = edge.column(p.x + x1);
    for (double column = edge.column(p.x + x0); column <= last; ++column) {
        const double begin = std::max(x0, edge.column_begin(column) - p.x);
        const double end = std::min(x1, edge.column_begin(column + 1) - p.x);
        if (begin < end) each(begin, end, edge.column_height(column) - p.y);
    }
}

/// ∫ max(0, level − h(x)) dx over [x0, x1] for a stair at its own phase: the area above the stair and below a level. Treads
/// are cut at both ends, and the whole ones between are an arithmetic series; all terms have one sign, so nothing cancels.
double stair_area_below(const Edge& stair, double level, double x0, double x1) {
    const double a = stair.texel_px();
    // The last column whose tread lies below the level: heights rise by a.
    const double first = stair.column(x0);
    const double first_height = stair.column_height(first);
    if (first_height >= level) return 0;
    const double reached = first + std::ceil((level - first_height) / a) - 1;
    const double last = std::min(stair.column(x1), reached);
    const double end = std::min(x1, stair.column_begin(last + 1));
    const auto above = [level](double h) { return std::max(0.0, level - h); };
    if (first == last) return (end - x0) * above(first_height);
    const double last_height = first_height + (last - first) * a;
    const double head = (stair.column_begin(first + 1) - x0) * above(first_height);
    const double tail = (end - stair.column_begin(last)) * above(last_height);
    const double whole = (last - first - 1) * a * (level - (first_height + last_height) / 2);
    return head + whole + tail;
}

/// Area of the square [−r, r]² above the line y = m·x − y₀, for the point that lies y₀ above the line.
double square_above_line(double r, double slope, double y0) {
    // ∫ max(0, t − m·x) dx over [−r, r], for the square's upper and lower side.
    const auto area_below = [&](double level) {
        const double rise = slope * r;
        const double ramp = std::clamp(level + rise, 0.0, 2 * rise);
        return (rise > 0 ? ramp * ramp / (2 * slope) : 0) + 2 * r * std::max(0.0, level - rise);
    };
    return area_below(y0 + r) - area_below(y0 - r);
}

/// Cumulative normal of σ = ½ cut at ±1.5 and renormalised; both its tails are exact.
double cut_normal(double x) {
    static const double kMass = std::erf(3 / std::numbers::sqrt2);
    return std::clamp((std::erf(x * std::numbers::sqrt2) / kMass + 1) / 2, 0.0, 1.0);
}

double cut_normal_density(double x) {
    static const double kScale = std::sqrt(2 / std::numbers::pi) / std::erf(3 / std::numbers::sqrt2);
    return kScale * std::exp(-2 * x * x);
}

/// Nodes and weights of Gauss–Legendre quadrature on [−1, 1], by Newton's method on the Legendre polynomial.
template <size_t N>
struct GaussLegendre {
    std::array<double, N> nodes{};
    std::array<double, N> weights{};

    GaussLegendre() {
        for (size_t i = 0; i < N; ++i) {
            double x = std::cos(std::numbers::pi * (i + 0.75) / (N + 0.5));
            double derivative = 0;
            for (int step = 0; step < 20; ++step) {
                double p0 = 1;
                double p1 = x;
                for (size_t n = 2; n <= N; ++n) {
                    const double p2 = ((2.0 * n - 1) * x * p1 - (n - 1.0) * p0) / n;
                    p0 = p1;
                    p1 = p2;
                }
                derivative = N * (x * p1 - p0) / (x * x - 1);
                x -= p1 / derivative;
            }
            nodes[i] = x;
            weights[i] = 2 / ((1 - x * x) * derivative * derivative);
        }
    }
};

/// Mass of the cut Gaussian above the line y = m·x − d: ∫ density(x)·[1 − Φ(m·x − d)] dx, in units of the radius.
double gaussian_above_line(double slope, double d) {
    static const GaussLegendre<24> kRule;
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
        lit = cut_normal(low);
    } else {
        return cut_normal(d);
    }
    const double length = high - low;
    const int pieces = static_cast<int>(std::ceil(std::max({1.0, length / 0.5, std::min(length * slope, 2 * kCut)})));
    for (int piece = 0; piece < pieces; ++piece) {
        const double begin = low + length * piece / pieces;
        const double half = length / pieces / 2;
        for (size_t i = 0; i < kRule.nodes.size(); ++i) {
            const double x = begin + half * (1 + kRule.nodes[i]);
            lit += half * kRule.weights[i] * cut_normal_density(x) * cut_normal(d - slope * x);
        }
    }
    return lit;
}

/// S(x) = ∫₀ˣ √(1 − t²) dt, x limited to the unit disk.
double quarter_area(double x) {
    if (std::abs(x) >= 1) return std::copysign(std::numbers::pi / 4, x);
    return (x * std::sqrt(1 - x * x) + std::asin(x)) / 2;
}

/// Area of the unit disk within b ≤ x ≤ e and above h.
double disk_column_area(double b, double e, double h) {
    if (h >= 1 || b >= 1 || e <= -1) return 0;
    if (h <= -1) return 2 * (quarter_area(e) - quarter_area(b));
    // Where |x| < w the level cuts the disk. What lies above it there is S(x) − h·x; below the level a mirrored cap is
    // missing from the whole column.
    const double w = std::sqrt((1 - h) * (1 + h));
    const double cut_b = std::clamp(b, -w, w);
    const double cut_e = std::clamp(e, -w, w);
    const double cap = quarter_area(cut_e) - quarter_area(cut_b) - std::abs(h) * (cut_e - cut_b);
    return h >= 0 ? cap : 2 * (quarter_area(e) - quarter_area(b)) - cap;
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
    double v = 0;
    switch (kernel_.shape) {
        case KernelShape::box: v = box(edge, p); break;
        case KernelShape::gaussian: v = gaussian(edge, p); break;
        case KernelShape::disk: v = disk(edge, p); break;
        case KernelShape::poisson: v = poisson(edge, p, rotation); break;
    }
    return std::clamp(v, 0.0, 1.0);
}

double Filter::box(const Edge& edge, Point p) const {
    const double r = kernel_.radius_px;
    double lit = 0;
    if (edge.pattern() == Pattern::line) {
        lit = square_above_line(r, edge.slope(), p.y);
    } else if (edge.pattern() == Pattern::stair) {
        // Lit area of a column: clamp(p.y + r − h, 0, 2r) = max(0, u) − max(0, u − 2r).
        lit = stair_area_below(edge, p.y + r, p.x - r, p.x + r) - stair_area_below(edge, p.y - r, p.x - r, p.x + r);
    } else {
        for_each_column(edge, p, -r, r,
                        [&](double b, double e, double h) { lit += (e - b) * std::clamp(r - h, 0.0, 2 * r); });
    }
    return lit / (4 * r * r);
}

double Filter::gaussian(const Edge& edge, Point p) const {
    const double r = kernel_.radius_px;
    if (edge.pattern() == Pattern::line) return gaussian_above_line(edge.slope(), p.y / r);
    double lit = 0;
    double mass_before = 0;  // up to the column at hand
    for_each_column(edge, p, -1.5 * r, 1.5 * r, [&](double, double e, double h) {
        const double mass = cut_normal(e / r);
        lit += (mass - mass_before) * cut_normal(-h / r);
        mass_before = mass;
    });
    return lit;
}

double Filter::disk(const Edge& edge, Point p) const {
    const double r = kernel_.radius_px;
    if (edge.pattern() == Pattern::line) {
        const double distance = p.y / (r * std::sqrt(1 + edge.slope() * edge.slope()));
        return 0.5 + 2 * quarter_area(distance) / std::numbers::pi;
    }
    double lit = 0;
    for_each_column(edge, p, -r, r,
                    [&](double b, double e, double h) { lit += disk_column_area(b / r, e / r, h / r); });
    return lit / std::numbers::pi;
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
