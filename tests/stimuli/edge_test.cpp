#include "stimuli/edge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/error.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

TEST(Edge, StandsWhereTheDesignSaysItDoes) {
    EXPECT_EQ(Edge::step(10).height(-0.001), -5);
    EXPECT_EQ(Edge::step(10).height(0), 5);
    EXPECT_EQ(Edge::stair(10).height(-5), 0);
    EXPECT_EQ(Edge::stair(10).height(4.999), 0);
    EXPECT_EQ(Edge::stair(10).height(5), 10);
    EXPECT_EQ(Edge::stair(10).height(-5.001), -10);
    EXPECT_EQ(Edge::line(0.5).height(8), 4);
}

TEST(Edge, StairLeavesEqualTrianglesOnBothSidesOfItsLine) {
    // Over one period the mean height of the stair is that of the line y = x.
    const Edge stair = Edge::stair(7);
    double difference = 0;
    constexpr int kSamples = 70000;
    for (int i = 0; i < kSamples; ++i) {
        const double x = -3.5 + 7 * (i + 0.5) / kSamples;
        difference += (stair.height(x) - x) / kSamples;
    }
    EXPECT_NEAR(difference, 0, 1e-9);
}

TEST(Edge, AreaBelowALevelEqualsARiemannSumOfTheHeight) {
    Random random(1);
    for (const Edge& edge : {Edge::step(8), Edge::stair(8), Edge::line(0.3), Edge::line(1), Edge::line(0)}) {
        for (int i = 0; i < 40; ++i) {
            const double x0 = -40 + 60 * random.uniform();
            const double x1 = x0 + 40 * random.uniform();
            const double level = -40 + 80 * random.uniform();
            constexpr int kCells = 200000;
            double sum = 0;
            for (int k = 0; k < kCells; ++k) {
                const double x = x0 + (x1 - x0) * (k + 0.5) / kCells;
                sum += std::max(0.0, level - edge.height(x));
            }
            // A jump of 8 within a cell of 40/200,000 bounds the sum's error at each of at most 6 jumps.
            EXPECT_NEAR(edge.area_below(level, x0, x1), sum * (x1 - x0) / kCells, 0.012)
                << name(edge.pattern()) << " level " << level << " over [" << x0 << ", " << x1 << "]";
        }
    }
}

TEST(Edge, RefusesWhatIsNoSize) {
    EXPECT_THROW(Edge::step(0), InputError);
    EXPECT_THROW(Edge::stair(-1), InputError);
    EXPECT_THROW(Edge::stair(NAN), InputError);
    EXPECT_THROW(Edge::step(INFINITY), InputError);
    EXPECT_THROW(Edge::line(-0.1), InputError);
}

}  // namespace
}  // namespace stairstep
