#include <gtest/gtest.h>

#include <cmath>

#include "renderer/comparison.h"

namespace stairstep {
namespace {

TEST(Comparison, PicturesDifferByTheirLevels) {
    Image a(2, 2, 3);
    Image b = a;
    EXPECT_EQ(compare_pictures(a, b).max_levels, 0);
    b.at(0, 0)[1] = 9;
    b.at(1, 1)[2] = 2;
    const PictureDifference difference = compare_pictures(a, b);
    EXPECT_EQ(difference.max_levels, 9);
    EXPECT_DOUBLE_EQ(difference.rmse_levels, std::sqrt((81 + 4) / 12.0));
    EXPECT_DOUBLE_EQ(difference.share_over_1_level, 0.5);
    EXPECT_DOUBLE_EQ(difference.share_over_8_levels, 0.25);
    EXPECT_EQ(difference_scale(difference), 28);
    const Image shown = difference_picture(a, b, 28);
    EXPECT_EQ(shown.at(0, 0)[1], 252);
    EXPECT_EQ(shown.at(0, 1)[0], 0);
}

TEST(Comparison, VisibilityErrorsKnowThePenumbra) {
    const VisibilityError error = compare_visibility({0, 0.5f, 1, 0.5f}, {0, 0.25f, 1, 1});
    EXPECT_DOUBLE_EQ(error.max, 0.5);
    EXPECT_DOUBLE_EQ(error.penumbra_rmse, 0.25);
    EXPECT_DOUBLE_EQ(error.penumbra_share, 0.25);
    EXPECT_DOUBLE_EQ(error.rmse, std::sqrt((0.0625 + 0.25) / 4));
    EXPECT_DOUBLE_EQ(error.share_over_8_levels, 0.5);
}

TEST(Comparison, LightBleedsWhereTheTruthIsFullyDark) {
    // The second and the last aren't fully dark, whatever is drawn there.
    EXPECT_DOUBLE_EQ(compare_visibility({0.5f, 1, 0.25f, 0, 1}, {0, 0.125f, 0, 0, 1}).light_bleeding, 0.25);
    EXPECT_EQ(compare_visibility({0.5f, 1}, {0.25f, 1}).light_bleeding, 0) << "nothing dark";
    EXPECT_EQ(compare_visibility({0, 0}, {0, 0}).light_bleeding, 0);
}

TEST(Comparison, NoPenumbraIsNoError) {
    EXPECT_EQ(compare_visibility({0, 1}, {0, 1}).penumbra_rmse, 0);
}

TEST(Comparison, AnErrorThatStaysDoesNotWobble) {
    Wobble wobble;
    EXPECT_EQ(wobble.mean(), 0);
    // Values that floats hold exactly, so that their differences are exact too.
    for (const float moved : {0.0f, 0.25f, 0.125f}) wobble.add({moved + 0.5f, moved}, {moved, moved + 0.25f});
    EXPECT_EQ(wobble.frames(), 3u);
    EXPECT_EQ(wobble.mean(), 0);
}

TEST(Comparison, WobbleCountsEachChangeThatIsNotTrue) {
    Wobble wobble;
    wobble.add({0, 0}, {0, 0});
    EXPECT_EQ(wobble.mean(), 0) << "of one frame there is no change";
    wobble.add({0.5f, 0}, {0, 0});
    EXPECT_DOUBLE_EQ(wobble.mean(), 0.25) << "half of the pixels by 0.5";
    // Back: a change again. The other pixel stays while the true one goes to 1.
    wobble.add({0, 0}, {0, 1});
    EXPECT_DOUBLE_EQ(wobble.mean(), (0.5 + 0.5 + 1) / 4);
}

TEST(Comparison, ALateStepWobblesTwice) {
    // An edge that crosses a pixel a frame late: |−1| when the true one goes, |+1| when it follows.
    Wobble wobble;
    wobble.add({1}, {1});
    wobble.add({1}, {0});
    wobble.add({0}, {0});
    EXPECT_DOUBLE_EQ(wobble.mean(), 1);
}

}  // namespace
}  // namespace stairstep
