#include "stimuli/io/stroke.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace stairstep {
namespace {

TEST(Stroke, CoversItsLengthTimesItsWidthAroundItself) {
    for (const double width : {1.0, 1.4, 3.6}) {
        for (double degrees = 0; degrees < 180; degrees += 7.5) {
            const double angle = degrees * std::numbers::pi / 180;
            const Point middle{50.3, 49.6};
            const double dx = 30 * std::cos(angle);
            const double dy = 30 * std::sin(angle);
            Coverage coverage(100, 100);
            coverage.stroke({{middle.x - dx, middle.y - dy}, middle, {middle.x + dx, middle.y + dy}}, width);
            double sum = 0;
            double across = 0;
            for (int row = 0; row < 100; ++row) {
                for (int column = 0; column < 100; ++column) {
                    const double share = coverage.at(column, row);
                    ASSERT_GE(share, 0);
                    ASSERT_LE(share, 1);
                    sum += share;
                    across += share * ((row + 0.5 - middle.y) * dx - (column + 0.5 - middle.x) * dy) / 30;
                }
            }
            // Its ends are round: each adds up to half a disk of the pen, (w/2 + ½)² and less.
            EXPECT_GT(sum, 60 * width * 0.95) << width << " px at " << degrees;
            EXPECT_LT(sum, 60 * width * 1.05 + 3.2 * (width / 2 + 0.5) * (width / 2 + 0.5))
                << width << " px at " << degrees;
            EXPECT_NEAR(across / sum, 0, 0.1) << width << " px at " << degrees;
        }
    }
}

TEST(Stroke, DoesNotDarkenWhereStrokesLieOnEachOther) {
    const std::vector<Point> line{{2, 3.3}, {18, 8.1}};
    Coverage once(20, 12);
    Coverage twice(20, 12);
    once.stroke(line, 1.4);
    for (int i = 0; i < 3; ++i) twice.stroke(line, 1.4);
    for (int row = 0; row < 12; ++row) {
        for (int column = 0; column < 20; ++column) EXPECT_EQ(once.at(column, row), twice.at(column, row));
    }
}

TEST(Stroke, LeavesOutWhatLiesOutside) {
    Coverage coverage(10, 10);
    coverage.stroke({{-1e9, 4.5}, {1e9, 4.5}}, 1);
    coverage.stroke({{-40, -40}, {-20, 400}}, 1);
    for (int row = 0; row < 10; ++row) {
        for (int column = 0; column < 10; ++column) EXPECT_NEAR(coverage.at(column, row), row == 4, 1e-6);
    }
}

TEST(Stroke, LaysItsColourAsMuchAsItCovers) {
    Image image(4, 4, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), 200);
    Coverage coverage(2, 2);
    coverage.stroke({{-5, 1}, {5, 1}}, 1);  // half of each row
    coverage.lay(image, 1, 1, {100, 200, 250});
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            const bool inside = row >= 1 && row <= 2 && column >= 1 && column <= 2;
            EXPECT_EQ(image.at(column, row)[0], inside ? 150 : 200);
            EXPECT_EQ(image.at(column, row)[1], 200);
            EXPECT_EQ(image.at(column, row)[2], inside ? 225 : 200);
        }
    }
}

}  // namespace
}  // namespace stairstep
