#include "stimuli/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

/// The definition, by another road: between two kinks the lit share of a column is linear in x, so the trapezoid rule on
/// the pieces is exact. `kinks` holds every abscissa where the edge jumps or where a column starts or ends to be wholly lit.
double box_by_pieces(const Edge& edge, double radius, Point p, std::vector<double> kinks) {
    const double x0 = p.x - radius;
    const double x1 = p.x + radius;
    kinks.push_back(x0);
    kinks.push_back(x1);
    std::sort(kinks.begin(), kinks.end());
    double area = 0;
    for (size_t i = 0; i + 1 < kinks.size(); ++i) {
        const double a = std::max(x0, kinks[i]);
        const double b = std::min(x1, kinks[i + 1]);
        if (b <= a) continue;
        // Two interior points give the linear piece without touching its ends, where the edge may jump.
        const auto lit = [&](double x) { return std::clamp(p.y + radius - edge.height(x), 0.0, 2 * radius); };
        area += (lit(a + (b - a) / 4) + lit(b - (b - a) / 4)) / 2 * (b - a);
    }
    return area / (4 * radius * radius);
}

struct Case {
    Edge edge;
    double texel;
    double slope;
};

std::vector<double> kinks_of(const Case& c, double radius, Point p) {
    std::vector<double> kinks{0};
    if (c.edge.pattern() == Pattern::stair) {
        for (double k = std::floor((p.x - radius) / c.texel) - 1; k * c.texel < p.x + radius + c.texel; ++k) {
            kinks.push_back((k + 0.5) * c.texel);
        }
    }
    if (c.edge.pattern() == Pattern::line && c.slope > 0) {
        kinks.push_back((p.y + radius) / c.slope);
        kinks.push_back((p.y - radius) / c.slope);
    }
    return kinks;
}

TEST(Visibility, BoxEqualsItsDefinitionAtRandomPoints) {
    Random random(2);
    double largest_error = 0;
    for (int i = 0; i < 20000; ++i) {
        const double texel = std::exp(std::log(0.7) + random.uniform() * std::log(60 / 0.7));
        const double slope = random.below(4) == 0 ? 1 : random.uniform();
        const Case cases[] = {
            {Edge::step(texel), texel, 0}, {Edge::stair(texel), texel, 1}, {Edge::line(slope), 0, slope}};
        const Case& c = cases[random.below(3)];
        const double radius = std::exp(std::log(0.3) + random.uniform() * std::log(400 / 0.3));
        const double x = 640 * (random.uniform() - 0.5);
        const double near_edge = 1.3 * radius * (2 * random.uniform() - 1);
        const Point p{x, c.edge.height(x) + near_edge};
        const double error = std::abs(visibility(c.edge, {KernelShape::box, radius}, p) -
                                      box_by_pieces(c.edge, radius, p, kinks_of(c, radius, p)));
        largest_error = std::max(largest_error, error);
    }
    EXPECT_LT(largest_error, 1e-12);
}

TEST(Visibility, OfALineAtItsOwnEdgeIsOneHalf) {
    for (const double slope : {0.0, 0.01, 0.3, 1.0}) {
        for (const double radius : {0.5, 3.0, 35.0, 1000.0}) {
            for (const double x : {-300.0, 0.0, 17.3}) {
                EXPECT_NEAR(visibility(Edge::line(slope), {KernelShape::box, radius}, {x, slope * x}), 0.5, 1e-12);
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
    for (const Edge& edge : {Edge::step(10), Edge::stair(10), Edge::line(0.4)}) {
        for (const double radius : {0.5, 4.0, 21.7, 90.0}) {
            const Kernel kernel{KernelShape::box, radius};
            for (double x = -33.3; x < 34; x += 3.7) {
                double below = 0;
                for (double y = -120; y <= 120; y += 0.7) {
                    const double v = visibility(edge, kernel, {x, y});
                    EXPECT_GE(v, below - 1e-14);
                    EXPECT_NEAR(v + visibility(edge, kernel, {-x, -y}), 1, 1e-12);
                    below = v;
                }
            }
        }
    }
}

TEST(Visibility, DependsOnlyOnRatiosOfLengths) {
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        const double scale = 0.1 + 20 * random.uniform();
        const double radius = 1 + 60 * random.uniform();
        const Point p{100 * (random.uniform() - 0.5), 100 * (random.uniform() - 0.5)};
        const Point scaled{scale * p.x, scale * p.y};
        EXPECT_NEAR(visibility(Edge::stair(10), {KernelShape::box, radius}, p),
                    visibility(Edge::stair(10 * scale), {KernelShape::box, radius * scale}, scaled), 1e-12);
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
    EXPECT_THROW(visibility(Edge::line(0), {KernelShape::disk, 3}, {}), InputError);
}

}  // namespace
}  // namespace stairstep
