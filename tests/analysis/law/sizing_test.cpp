#include "analysis/law/sizing.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/law/law.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(Law, IsTheRadiusInTexels) {
    EXPECT_DOUBLE_EQ(filter_radius(10.0, LawParameters<double>{3.47}), 34.7);
    EXPECT_DOUBLE_EQ(filter_radius(10.0, LawParameters<double>{3.47, 2}), 36.7);
    EXPECT_DOUBLE_EQ(filter_radius(16.0, LawParameters<double>{2, 0, 0.5}), 8);
}

TEST(Sizing, GivesTheThesissNumber) {
    EXPECT_EQ(shadow_map_size({.slope = 3.47, .radius = 0.4, .extent = 28}).texels, 243);
    EXPECT_EQ(shadow_map_size({.slope = 3.47, .radius = 0.4 / 28, .extent = 1}).texels, 243);  // r_uv
}

RC_GTEST_PROP(Sizing, TakesTheFewestTexelsThatTheLawAllows, ()) {
    const auto draw = [](double low, double high) {
        return low * std::pow(high / low, *rc::gen::inRange(0, 100001) / 100000.0);
    };
    const SizeRequest request{.slope = draw(0.5, 20), .radius = draw(1e-3, 1e3), .extent = draw(1e-2, 1e4)};
    const MapSize size = shadow_map_size(request);
    RC_PRE(size.limit == SizeLimit::law);
    // N texels are fine enough, and N − 1 would not be.
    RC_ASSERT(request.radius >= request.slope * (request.extent / size.texels) * (1 - 2e-12));
    if (size.texels > 1) RC_ASSERT(request.radius < request.slope * (request.extent / (size.texels - 1)));
}

TEST(Sizing, RoundingCostsNoTexel) {
    for (int n = 1; n <= 4096; ++n) {
        EXPECT_EQ(shadow_map_size({.slope = 3, .radius = 0.3, .extent = n * 0.1}).texels, n) << n;
    }
}

TEST(Sizing, StopsAtThePixelAndAtTheTextureLimit) {
    const MapSize screen = shadow_map_size({.slope = 3.47, .radius = 1e-9, .extent = 10, .smallest_texel = 0.01});
    EXPECT_EQ(screen.texels, 1000);
    EXPECT_EQ(screen.limit, SizeLimit::screen);
    for (const double radius : {1e-9, 1e-200, 5e-324}) {
        const MapSize full = shadow_map_size({.slope = 3.47, .radius = radius, .extent = 28, .largest_size = 8192});
        EXPECT_EQ(full.texels, 8192);
        EXPECT_EQ(full.limit, SizeLimit::largest_size);
        EXPECT_GT(full.texels_wanted, 8192);
        EXPECT_TRUE(std::isfinite(full.texels_wanted));
    }
    EXPECT_EQ(shadow_map_size({.slope = 3.47, .radius = 1e9, .extent = 1}).texels, 1);
}

TEST(Sizing, RefusesWhatIsNoLength) {
    const double bad[] = {0, -1, std::nan(""), std::numeric_limits<double>::infinity()};
    for (const double value : bad) {
        EXPECT_THROW(shadow_map_size({.slope = value, .radius = 1, .extent = 1}), InputError) << value;
        EXPECT_THROW(shadow_map_size({.slope = 1, .radius = value, .extent = 1}), InputError) << value;
        EXPECT_THROW(shadow_map_size({.slope = 1, .radius = 1, .extent = value}), InputError) << value;
    }
    EXPECT_THROW(shadow_map_size({.slope = 1, .radius = 1, .extent = 1, .smallest_texel = -1}), InputError);
    EXPECT_THROW(shadow_map_size({.slope = 1, .radius = 1, .extent = 1, .largest_size = 0}), InputError);
}

}  // namespace
}  // namespace stairstep
