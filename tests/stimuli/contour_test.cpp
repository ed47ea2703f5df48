#include "stimuli/contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stimuli/error.h"

namespace stairstep {
namespace {

constexpr KernelShape kSymmetric[] = {KernelShape::box, KernelShape::disk, KernelShape::gaussian};
constexpr Window kWindow{-60, 60, -45, 45};

TEST(Contour, HalfOfALineIsTheLine) {
    for (const KernelShape shape : kSymmetric) {
        for (const double slope : {0.0, 0.05, 0.7, 1.0, 4.0}) {
            for (const double radius : {0.0, 0.5, 7.0, 90.0}) {
                const Edge line = Edge::line(slope);
                for (const Point p : contour(line, Filter({shape, radius}), 0.5, kWindow, 2)) {
                    EXPECT_NEAR(p.y, slope * p.x, 1e-8) << name(shape) << " " << slope << " " << radius;
                }
            }
        }
    }
}

TEST(Contour, OfALineIsStraightAtEveryLevelAndMirrored) {
    for (const KernelShape shape : kSymmetric) {
        for (const double slope : {0.0, 0.3, 1.0, 2.5}) {
            const Edge line = Edge::line(slope);
            const Filter filter({shape, 30});
            for (const double level : contour_levels(9)) {
                const double offset = contour_height(line, filter, level, 0);
                for (const Point p : contour(line, filter, level, kWindow, 1)) {
                    EXPECT_NEAR(p.y - slope * p.x, offset, 1e-8) << name(shape) << " " << slope << " " << level;
                }
                EXPECT_NEAR(contour_height(line, filter, 1 - level, 0), -offset, 1e-8);
            }
        }
    }
}

TEST(Contour, OfALevelLineLiesWhereTheClosedFormSays) {
    const Edge line = Edge::line(0);
    const double r = 24;
    for (const double level : contour_levels(19)) {
        EXPECT_NEAR(contour_height(line, Filter({KernelShape::box, r}), level, 3), (2 * level - 1) * r, 1e-8);
        // The disk's segment and the cut Gaussian, put in the other way round.
        const double d = contour_height(line, Filter({KernelShape::disk, r}), level, 3) / r;
        EXPECT_NEAR(0.5 + (d * std::sqrt(1 - d * d) + std::asin(d)) / std::numbers::pi, level, 1e-10);
        const double g = contour_height(line, Filter({KernelShape::gaussian, r}), level, 3) / r;
        EXPECT_NEAR((1 + std::erf(g * std::numbers::sqrt2) / std::erf(3 / std::numbers::sqrt2)) / 2, level, 1e-10);
    }
}

TEST(Contour, OfAStepUnderABoxRampsAsTheClosedFormSays) {
    for (const double a : {5.0, 20.0}) {
        const double r = 60;
        const Filter filter({KernelShape::box, r});
        for (const double level : contour_levels(3)) {
            const double middle = (2 * level - 1) * r;
            for (const Point p : contour(Edge::step(a), filter, level, {-90, 90, -60, 60}, 1)) {
                const double expected = std::clamp(p.x, -r, r) * a / (2 * r) + middle;
                // While both treads cut the kernel.
                ASSERT_LE(std::abs(expected) + a / 2, r);
                EXPECT_NEAR(p.y, expected, 1e-8) << a << " " << level << " at " << p.x;
            }
        }
    }
}

TEST(Contour, OfAStairLeavesItsLinesByNoMoreThanTheResidual) {
    // |V_stair − V_line| ≤ (a/r)²/32 under a box of r ≥ a, and a few per cent less is reached.
    const Edge line = Edge::line(1);
    for (const double a : {5.0, 12.0, 30.0}) {
        for (const double ratio : {1.0, 1.7, 3.47, 8.0}) {
            const double r = ratio * a;
            const double residual = 1 / (32 * ratio * ratio);
            const Filter filter({KernelShape::box, r});
            double largest = 0;
            for (const double level : contour_levels(9)) {
                for (const Point p : contour(Edge::stair(a), filter, level, kWindow, 0.5)) {
                    largest = std::max(largest, std::abs(filter.visibility(line, p) - level));
                    if (level == 0.5) {
                        // Across the line V rises by (2r − |t|)/(4r²) per px at the height t above it.
                        const double steepness = (2 * r - a / 2) / (4 * r * r);
                        EXPECT_LE(std::abs(p.y - p.x), residual / steepness + 1e-8) << a << " " << ratio;
                    }
                }
            }
            EXPECT_LE(largest, residual + 1e-9) << a << " " << ratio;
            EXPECT_GE(largest, 0.9 * residual) << a << " " << ratio;
        }
    }
}

TEST(Contour, SeparatesWhatIsDarkerFromWhatIsLighter) {
    constexpr KernelShape kAll[] = {KernelShape::box, KernelShape::disk, KernelShape::gaussian, KernelShape::poisson};
    const Edge edges[] = {Edge::step(12), Edge::stair(12), Edge::sampled(0.3, 12, {0.2, 0.7}), Edge::sampled(5, 7),
                          Edge::line(0.4)};
    for (const KernelShape shape : kAll) {
        for (const Edge& edge : edges) {
            for (const double radius : {0.0, 3.0, 20.0}) {
                const Filter filter({shape, radius});
                double below = -1e9;
                for (const double level : contour_levels(4)) {
                    const std::vector<Point> points = contour(edge, filter, level, kWindow, 1.5);
                    EXPECT_EQ(points.front().x, kWindow.left);
                    EXPECT_EQ(points.back().x, kWindow.right);
                    EXPECT_GE(points.front().y, below - 1e-8) << "contours cross";
                    below = points.front().y;
                    for (size_t i = 0; i < points.size(); ++i) {
                        const Point p = points[i];
                        EXPECT_GE(filter.visibility(edge, {p.x, p.y + 1e-7}), level - 1e-12);
                        EXPECT_LE(filter.visibility(edge, {p.x, p.y - 1e-7}), level + 1e-12);
                        if (i == 0) continue;
                        const double width = p.x - points[i - 1].x;
                        const double rise = p.y - points[i - 1].y;
                        EXPECT_GT(width, 0);
                        EXPECT_GE(rise, -1e-8) << "falls";
                        const bool is_seen = p.y >= kWindow.bottom && points[i - 1].y <= kWindow.top;
                        EXPECT_TRUE(!is_seen || width <= 1e-3 || (width <= 1.5 && rise <= 1.5));
                    }
                }
            }
        }
    }
}

TEST(Contour, WithoutAFilterIsTheEdgeAtEveryLevel) {
    const Edge stair = Edge::stair(10);
    const Filter none({KernelShape::box, 0});
    for (const double level : {0.01, 0.5, 0.99}) {
        for (const double x : {-14.9, -5.1, 0.0, 4.9, 5.0, 17.0}) {
            EXPECT_NEAR(contour_height(stair, none, level, x), stair.height(x), 1e-8);
        }
    }
}

TEST(Contour, LevelsAreEquallySpacedAndAsManyAsAsked) {
    for (const int count : {1, 2, 5, kMostContours}) {
        const std::vector<double> levels = contour_levels(count);
        ASSERT_EQ(levels.size(), static_cast<size_t>(count));
        double last = 0;
        for (const double level : levels) {
            EXPECT_NEAR(level - last, 1.0 / (count + 1), 1e-15);
            last = level;
        }
        EXPECT_NEAR(1 - last, 1.0 / (count + 1), 1e-15);
    }
    for (const int count : {-1, 0, kMostContours + 1}) EXPECT_THROW(contour_levels(count), InputError);
}

}  // namespace
}  // namespace stairstep
