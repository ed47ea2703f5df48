#include "stimuli/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

using boost::math::quadrature::gauss_kronrod;

/// Mass of the kernel's slice at x (relative to p, in units of r) that lies above h: the inner integral of the definition.
double slice_above(KernelShape shape, double x, double h) {
    if (shape == KernelShape::box) return std::clamp((1 - h) / 2, 0.0, 1.0) / 2;
    if (shape == KernelShape::disk) {
        const double s = std::sqrt(std::max(0.0, 1 - x * x));
        return (s - std::clamp(h, -s, s)) / std::numbers::pi;
    }
    // Cut normals by Boost: σ = ½, ±1.5, in both directions.
    const boost::math::normal normal(0, 0.5);
    const double mass = boost::math::cdf(normal, 1.5) - boost::math::cdf(normal, -1.5);
    const double above = boost::math::cdf(normal, 1.5) - boost::math::cdf(normal, std::clamp(h, -1.5, 1.5));
    return boost::math::pdf(normal, x) / mass * above / mass;
}

/// V by the definition, with adaptive quadrature over x. It splits the range where the integrand has kinks or jumps, so that
/// each piece is smooth; the disk's is in the angle, x = sin t, where it is smooth up to the rim.
double visibility_by_quadrature(const Edge& edge, const Kernel& kernel, Point p) {
    const double r = kernel.radius_px;
    const double reach = support(kernel.shape);
    std::vector<double> ends{-reach, reach};
    const auto add_kinks_of_level = [&](double h) {  // where a level meets the rim of the disk
        if (kernel.shape != KernelShape::disk || std::abs(h) >= 1) return;
        ends.push_back(std::sqrt(1 - h * h));
        ends.push_back(-ends.back());
    };
    if (edge.pattern() == Pattern::line) {
        if (edge.slope() > 0) {
            for (const double side : {-reach, reach})
                ends.push_back(((p.y - edge.height(p.x)) / r + side) / edge.slope());
        }
        if (kernel.shape == KernelShape::disk) {  // where the line meets the rim: (m x − d)² = 1 − x²
            const double m = edge.slope();
            const double d = (p.y - edge.height(p.x)) / r;
            const double discriminant = m * m * d * d - (1 + m * m) * (d * d - 1);
            if (discriminant > 0) {
                ends.push_back((m * d + std::sqrt(discriminant)) / (1 + m * m));
                ends.push_back((m * d - std::sqrt(discriminant)) / (1 + m * m));
            }
        }
    } else {
        for (double c = edge.column(p.x - reach * r); c <= edge.column(p.x + reach * r); ++c) {
            ends.push_back((edge.column_begin(c) - p.x) / r);
            add_kinks_of_level((edge.column_height(c) - p.y) / r);
        }
    }
    std::sort(ends.begin(), ends.end());

    double sum = 0;
    for (size_t i = 0; i + 1 < ends.size(); ++i) {
        const double begin = std::clamp(ends[i], -reach, reach);
        const double end = std::clamp(ends[i + 1], -reach, reach);
        if (end - begin < 1e-300) continue;
        // Within a piece a staircase has one height: ask in the middle, not at an end where rounding decides.
        const double middle = p.x + r * (begin + end) / 2;
        const auto height = [&](double x) {
            return (edge.height(edge.pattern() == Pattern::line ? p.x + r * x : middle) - p.y) / r;
        };
        if (kernel.shape == KernelShape::disk) {
            sum += gauss_kronrod<double, 31>::integrate(
                [&](double t) { return slice_above(kernel.shape, std::sin(t), height(std::sin(t))) * std::cos(t); },
                std::asin(begin), std::asin(end), 3, 1e-13);
        } else {
            sum += gauss_kronrod<double, 31>::integrate(
                [&](double x) { return slice_above(kernel.shape, x, height(x)); }, begin, end, 3, 1e-13);
        }
    }
    return sum;
}

/// An edge of any kind with a texel size and phase of its own.
Edge random_edge(Random& random) {
    const double texel = 2 + 58 * random.uniform();
    const Phase phase = random.below(2) == 0 ? Phase{} : Phase{random.uniform(), random.uniform()};
    switch (random.below(6)) {
        case 0: return Edge::step(texel, phase);
        case 1: return Edge::stair(texel, phase);
        case 2: return Edge::sampled(random.uniform(), texel, phase);
        case 3: return Edge::sampled(3 * random.uniform(), texel, phase);
        case 4: return Edge::line(random.below(3) == 0 ? 1 : 3 * random.uniform());
        default: return Edge::line(0);
    }
}

double largest_error_over_random_points(KernelShape shape, int points, uint64_t seed) {
    Random random(seed);
    double largest = 0;
    for (int i = 0; i < points; ++i) {
        const Edge edge = random_edge(random);
        const double radius = std::exp(std::log(0.5) + random.uniform() * std::log(150 / 0.5));
        const double x = 640 * (random.uniform() - 0.5);
        const Point p{x, edge.height(x) + 1.8 * radius * (2 * random.uniform() - 1)};
        const Kernel kernel{shape, radius};
        largest = std::max(largest, std::abs(visibility(edge, kernel, p) - visibility_by_quadrature(edge, kernel, p)));
    }
    return largest;
}

TEST(Visibility, EqualsItsDefinitionByQuadrature) {
    const double box = largest_error_over_random_points(KernelShape::box, 10000, 2);
    const double gaussian = largest_error_over_random_points(KernelShape::gaussian, 10000, 3);
    const double disk = largest_error_over_random_points(KernelShape::disk, 10000, 4);
    std::printf("largest error at 10,000 random points: box %.1e, gaussian %.1e, disk %.1e\n", box, gaussian, disk);
    EXPECT_LT(box, 1e-12);
    EXPECT_LT(gaussian, 1e-12);
    EXPECT_LT(disk, 1e-10);
}

constexpr KernelShape kSmoothKernels[] = {KernelShape::box, KernelShape::disk, KernelShape::gaussian};

std::vector<Edge> some_edges() {
    return {Edge::step(10),         Edge::stair(10), Edge::stair(7.3), Edge::sampled(0.3, 10),
            Edge::sampled(2.2, 10), Edge::line(0),   Edge::line(0.4),  Edge::line(1)};
}

TEST(Visibility, IsZeroOrOneBeyondTheSupport) {
    for (const Edge& edge : some_edges()) {
        for (const KernelShape shape : kSmoothKernels) {
            for (const double radius : {0.5, 4.0, 35.0}) {
                const double reach = support(shape) * radius;
                for (double x = -50; x < 50; x += 3.3) {
                    EXPECT_EQ(visibility(edge, {shape, radius}, {x, edge.height(x + reach) + reach * 1.0001}), 1);
                    EXPECT_EQ(visibility(edge, {shape, radius}, {x, edge.height(x - reach) - reach * 1.0001}), 0);
                }
            }
        }
    }
}

TEST(Visibility, OfPoissonTapsIsTheShareOfTapsInTheLight) {
    const Kernel kernel{.shape = KernelShape::poisson, .radius_px = 20, .taps = 37, .seed = 5};
    const Filter filter(kernel);
    const std::vector<KernelTap> taps = poisson_taps(37, 5);
    for (const double y : {-15.0, -3.0, 0.0, 7.0}) {
        int above = 0;
        for (const KernelTap& tap : taps) above += y + 20.0 * tap.y >= 0;
        EXPECT_DOUBLE_EQ(filter.visibility(Edge::line(0), {0, y}), above / 37.0);
        // Half a turn swaps up and down.
        int below = 0;
        for (const KernelTap& tap : taps) below += y - 20.0 * tap.y >= 0;
        EXPECT_DOUBLE_EQ(filter.visibility(Edge::line(0), {0, y}, std::numbers::pi), below / 37.0);
    }
}

TEST(Visibility, OfManyPoissonTapsComesNearTheDisk) {
    // 4,096 spread taps: discrepancy far below that of 4,096 random ones, 1/√N = .016.
    const Filter taps({.shape = KernelShape::poisson, .radius_px = 30, .taps = 4096});
    for (const Edge& edge : some_edges()) {
        for (double y = -30; y <= 30; y += 5) {
            EXPECT_NEAR(taps.visibility(edge, {3, y}), visibility(edge, {KernelShape::disk, 30}, {3, y}), 0.008);
        }
    }
}

TEST(Visibility, OfALineAtItsOwnEdgeIsOneHalf) {
    for (const double slope : {0.0, 0.01, 0.3, 1.0}) {
        for (const double radius : {0.5, 3.0, 35.0, 1000.0}) {
            for (const double x : {-300.0, 0.0, 17.3}) {
                for (const KernelShape shape : kSmoothKernels) {
                    EXPECT_NEAR(visibility(Edge::line(slope), {shape, radius}, {x, slope * x}), 0.5, 1e-12);
                }
            }
        }
    }
}

TEST(Visibility, StairAndLineDifferByASixteenthOfHalfTheSquaredTexelShare) {
    // |V_stair − V_line| ≤ (a/r)²/32, reached to 4 %.
    for (const double texel : {5.0, 10.0, 30.0}) {
        for (const double radii : {1.0, 2.0, 3.47, 8.0}) {
            const Kernel kernel{KernelShape::box, radii * texel};
            double largest = 0;
            for (double x = -texel; x <= texel; x += texel / 64) {
                for (double y = -1.2 * kernel.radius_px; y <= 1.2 * kernel.radius_px; y += texel / 64) {
                    largest = std::max(largest, std::abs(visibility(Edge::stair(texel), kernel, {x, x + y}) -
                                                         visibility(Edge::line(1), kernel, {x, x + y})));
                }
            }
            const double bound = 1 / (32 * radii * radii);
            EXPECT_LE(largest, bound * (1 + 1e-9));
            EXPECT_GE(largest, 0.96 * bound) << "a " << texel << " r/a " << radii;
        }
    }
}

TEST(Visibility, StepAndHorizontalLineDifferByAQuarterOfTheTexelShare) {
    for (const double radii : {1.0, 3.47, 16.0}) {
        const double texel = 10;
        const Kernel kernel{KernelShape::box, radii * texel};
        double largest = 0;
        for (double x = -200; x <= 200; x += 0.5) {
            for (double y = -200; y <= 200; y += 0.5) {
                largest = std::max(largest, std::abs(visibility(Edge::step(texel), kernel, {x, y}) -
                                                     visibility(Edge::line(0), kernel, {x, y})));
            }
        }
        EXPECT_NEAR(largest, 1 / (4 * radii), 1e-9);
    }
}

TEST(Visibility, RisesWithHeightAndMirrorsAboutTheCentre) {
    for (const Edge& edge : {Edge::step(10), Edge::stair(10), Edge::line(0.4), Edge::line(0)}) {
        for (const KernelShape shape : kSmoothKernels) {
            for (const double radius : {0.5, 4.0, 21.7, 90.0}) {
                const Filter filter({shape, radius});
                for (double x = -33.3; x < 34; x += 3.7) {
                    double below = 0;
                    for (double y = -140; y <= 140; y += 0.7) {
                        const double v = filter.visibility(edge, {x, y});
                        EXPECT_GE(v, below - 1e-14);
                        EXPECT_NEAR(v + filter.visibility(edge, {-x, -y}), 1, 1e-12);
                        below = v;
                    }
                }
            }
        }
    }
}

TEST(Visibility, DependsOnlyOnRatiosOfLengths) {
    Random random(3);
    for (int i = 0; i < 6000; ++i) {
        const double scale = 0.1 + 20 * random.uniform();
        const double radius = 1 + 60 * random.uniform();
        const double slope = 2 * random.uniform();
        const Phase phase{random.uniform(), random.uniform()};
        const Point p{100 * (random.uniform() - 0.5), 100 * (random.uniform() - 0.5)};
        const Point scaled{scale * p.x, scale * p.y};
        const KernelShape shape = kSmoothKernels[i % 3];
        EXPECT_NEAR(visibility(Edge::sampled(slope, 10, phase), {shape, radius}, p),
                    visibility(Edge::sampled(slope, 10 * scale, phase), {shape, radius * scale}, scaled), 1e-11);
    }
}

TEST(Visibility, WithoutAFilterIsTheShadowTest) {
    const Kernel none{KernelShape::box, 0};
    EXPECT_EQ(visibility(Edge::step(5), none, {-1, -2.5}), 1);
    EXPECT_EQ(visibility(Edge::step(5), none, {-1, -2.6}), 0);
    EXPECT_EQ(visibility(Edge::stair(10), none, {6, 9.9}), 0);
    EXPECT_EQ(visibility(Edge::stair(10), none, {6, 10}), 1);
}

TEST(Visibility, RefusesWhatItCannotComputeExactly) {
    EXPECT_THROW(visibility(Edge::line(0), {KernelShape::box, -1}, {}), InputError);
    EXPECT_THROW(visibility(Edge::line(0), {KernelShape::box, NAN}, {}), InputError);
    EXPECT_THROW(visibility(Edge::line(0), {.shape = KernelShape::poisson, .radius_px = 3, .taps = 0}, {}), InputError);
    EXPECT_THROW(visibility(Edge::line(0), {.shape = KernelShape::poisson, .radius_px = 3, .taps = 5000}, {}),
                 InputError);
}

}  // namespace
}  // namespace stairstep
