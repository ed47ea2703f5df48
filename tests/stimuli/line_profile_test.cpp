#include "stimuli/line_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "stimuli/random.h"
#include "stimuli/visibility.h"

namespace stairstep {
namespace {

TEST(LineProfile, IsWhatQuadratureAndClosedFormsGive) {
    // Filter integrates along the line, and is itself compared with quadrature of the definition.
    Random random(5);
    std::map<KernelShape, double> largest;
    for (int i = 0; i < 400; ++i) {
        const double slopes[] = {0, 1e-9, 5.0 / 640, 30.0 / 640, 0.37, 0.999999, 1, 1.5, 7, random.uniform() * 19};
        const double slope = slopes[i % 10];
        for (const KernelShape shape : {KernelShape::box, KernelShape::disk, KernelShape::gaussian}) {
            const Kernel kernel{shape, 1 + 100 * random.uniform()};
            const Edge line = Edge::line(slope);
            ASSERT_TRUE(LineProfile::suits(line, kernel));
            const LineProfile profile(line, kernel);
            const Filter filter(kernel);
            const double reach = support(shape) * kernel.radius_px * (1 + slope);
            for (int k = 0; k < 60; ++k) {
                const double above = (2.2 * random.uniform() - 1.1) * reach;
                const double error = std::abs(profile.visibility(above) - filter.visibility(line, {0, above}));
                ASSERT_LT(error, 1e-13) << name(shape) << ", slope " << slope << ", above " << above;
                largest[shape] = std::max(largest[shape], error);
            }
        }
    }
    for (const auto& [shape, error] : largest) {
        std::printf("%s: largest difference %.1e\n", std::string(name(shape)).c_str(), error);
    }
}

TEST(LineProfile, GoesFromNothingToAllAndIsHalfOnTheLine) {
    for (const KernelShape shape : {KernelShape::box, KernelShape::disk, KernelShape::gaussian}) {
        for (const double slope : {0.0, 0.04, 1.0, 3.0}) {
            const LineProfile profile(Edge::line(slope), {shape, 20});
            EXPECT_NEAR(profile.visibility(0), 0.5, 1e-14);
            const double beyond = 20 * support(shape) * (1 + slope) + 1e-9;
            EXPECT_EQ(profile.visibility(-beyond), 0);
            EXPECT_EQ(profile.visibility(beyond), 1);
        }
    }
}

TEST(LineProfile, LeavesTheRestToTheFilter) {
    EXPECT_FALSE(LineProfile::suits(Edge::stair(5), {KernelShape::box, 5}));
    EXPECT_FALSE(LineProfile::suits(Edge::line(1), {KernelShape::poisson, 5}));
    EXPECT_FALSE(LineProfile::suits(Edge::line(1), {KernelShape::box, 0}));
    EXPECT_FALSE(LineProfile::suits(Edge::line(1e6), {KernelShape::gaussian, 5}));
}

}  // namespace
}  // namespace stairstep
