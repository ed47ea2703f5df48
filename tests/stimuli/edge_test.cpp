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

/// A texel is dark if its centre lies below the silhouette: the definition, one texel at a time.
TEST(Edge, SampledIsWhatTheShadowTestLeavesOfTheSilhouette) {
    Random random(1);
    for (int i = 0; i < 3000; ++i) {
        const double slope = 3 * random.uniform();
        const double texel = 0.5 + 20 * random.uniform();
        const Phase phase{random.uniform(), random.uniform()};
        const Edge edge = Edge::sampled(slope, texel, phase);
        const double x = 200 * (random.uniform() - 0.5);
        const double y = slope * x + 3 * (1 + slope) * texel * (random.uniform() - 0.5);
        const double centre_x = (std::floor(x / texel - phase.x + 0.5) + phase.x) * texel;
        const double centre_y = (std::floor(y / texel - phase.y) + 0.5 + phase.y) * texel;
        const bool dark = centre_y < slope * centre_x;
        EXPECT_EQ(y < edge.height(x), dark) << "slope " << slope << " texel " << texel << " at " << x << ", " << y;
    }
}

TEST(Edge, StairAndStepAreSampledSilhouettes) {
    const Edge stair = Edge::sampled(1, 10, {0, 0});
    const Edge step = Edge::sampled(10.0 / 640, 10, {0.5, 0.5});
    for (double x = -300; x < 300; x += 0.37) {
        EXPECT_EQ(Edge::stair(10).height(x), stair.height(x));
        EXPECT_EQ(Edge::step(10).height(x), step.height(x)) << x;
    }
}

TEST(Edge, ColumnsTileTheAxis) {
    for (const Edge& edge :
         {Edge::stair(7, {0.2, 0.7}), Edge::sampled(0.4, 3.3, {0.9, 0.1}), Edge::step(10, {0.25, 0.5})}) {
        for (double x = -100; x < 100; x += 0.83) {
            const double column = edge.column(x);
            EXPECT_LE(edge.column_begin(column), x + 1e-9);
            EXPECT_GE(edge.column_begin(column + 1), x - 1e-9);
            EXPECT_EQ(edge.height(x), edge.column_height(column));
        }
    }
}

TEST(Edge, PhasesMoveTheGrid) {
    EXPECT_EQ(Edge::step(10, {0.25, 0}).height(2.4), -5);
    EXPECT_EQ(Edge::step(10, {0.25, 0}).height(2.5), 5);
    EXPECT_EQ(Edge::step(10, {0, 0.5}).height(1), 10);
    // A whole texel is no move for a stair.
    for (double x = -50; x < 50; x += 0.7) {
        EXPECT_NEAR(Edge::stair(10, {1, 0}).height(x), Edge::stair(10).height(x), 1e-12);
        EXPECT_NEAR(Edge::stair(10, {0, 1}).height(x), Edge::stair(10).height(x), 1e-12);
    }
}

TEST(Edge, RefusesWhatIsNoSize) {
    EXPECT_THROW(Edge::step(0), InputError);
    EXPECT_THROW(Edge::stair(-1), InputError);
    EXPECT_THROW(Edge::stair(NAN), InputError);
    EXPECT_THROW(Edge::step(INFINITY), InputError);
    EXPECT_THROW(Edge::line(-0.1), InputError);
    EXPECT_THROW(Edge::sampled(-1, 10), InputError);
    EXPECT_THROW(Edge::sampled(1, 10, {NAN, 0}), InputError);
}

}  // namespace
}  // namespace stairstep
