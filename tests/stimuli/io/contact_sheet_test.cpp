#include "stimuli/io/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "stimuli/contour.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(ContactSheet, ShowsStepsWithoutAFilterAndNoneUnderAWideOne) {
    const std::vector<Stimulus> stimuli{{.texel_px = 20}, {.texel_px = 20, .kernel = {KernelShape::box, 200}}};
    const Image sheet = contact_sheet(stimuli);
    ASSERT_GT(sheet.width, 400);
    // The first cell spans levels 0 to 255, the second is a gentle ramp around the middle.
    const auto levels = [&](int left) {
        uint8_t low = 255, high = 0;
        for (int row = 62; row < 62 + 100; ++row) {
            for (int column = left; column < left + 160; ++column) {
                low = std::min(low, *sheet.at(column, row));
                high = std::max(high, *sheet.at(column, row));
            }
        }
        return std::pair(low, high);
    };
    EXPECT_EQ(levels(76), std::pair(uint8_t{0}, uint8_t{255}));
    EXPECT_GT(levels(76 + 176).first, 30);
    EXPECT_LT(levels(76 + 176).second, 225);
    EXPECT_THROW(contact_sheet({{.pattern = Pattern::line}}), InputError);
}

/// Where, from the top of the first cell, a column of a sheet with contours crosses the dark pen: middles of its strokes,
/// px, weighted by darkness; to a quarter of a pixel, as the palest of a stroke can't be told from shading. The first cell
/// of such a sheet begins at (148, 172) and is 336 × 224 px.
std::vector<double> strokes_down(const Image& sheet, int column) {
    std::vector<double> middles;
    double weight = 0;
    double moment = 0;
    for (int row = 0; row < 224; ++row) {
        // Shading is above level 150 and the line's pen has much red; only the artifact's has little.
        const double darkness = std::max(0, 140 - *sheet.at(148 + column, 172 + row));
        weight += darkness;
        moment += darkness * (row + 0.5);
        if (weight > 0 && darkness == 0) {
            middles.push_back(moment / weight);
            weight = moment = 0;
        }
    }
    return middles;
}

TEST(ContactSheet, ShowsAsManyContoursAsAskedWhereTheyAre) {
    // Under a box a step's contours are at ±a/2 + (2v − 1)·r to its sides.
    const Stimulus step{.texel_px = 16, .kernel = {KernelShape::box, 80}};
    for (const int count : {1, 2, 5, 9}) {
        const Image sheet = contact_sheet({step}, count);
        ASSERT_EQ(sheet.channels, 3);
        for (const auto& [column, side] : {std::pair{20, -8.0}, std::pair{315, 8.0}}) {
            const std::vector<double> found = strokes_down(sheet, column);
            ASSERT_EQ(found.size(), static_cast<size_t>(count));
            for (int k = 1; k <= count; ++k) {
                const double height = side + (2.0 * k / (count + 1) - 1) * 80;
                EXPECT_NEAR(found[count - k], 112 - height, 0.25) << count << " contours, the " << k << "th";
            }
        }
    }
}

TEST(ContactSheet, ShowsTheLinesContoursBesideTheArtifacts) {
    // Left of a step the line is higher up than the lower tread: a·(½ + x/W).
    const Stimulus step{.texel_px = 30, .kernel = {KernelShape::box, 60}};
    const Image sheet = contact_sheet({step}, 1);
    const int column = 100;
    const double x = column + 0.5 - 168;
    const auto is_coloured = [&](double height) {
        const uint8_t* rgb = sheet.at(148 + column, 172 + static_cast<int>(112 - height));
        return rgb[0] - rgb[2] > 80;
    };
    EXPECT_TRUE(is_coloured(30 * x / 640));
    EXPECT_FALSE(is_coloured(30 * x / 640 + 5));
    EXPECT_FALSE(is_coloured(30 * x / 640 - 5));
}

TEST(ContactSheet, WithContoursIsTwiceAsLargeAndWithoutIsGrey) {
    const std::vector<Stimulus> stimuli{{.texel_px = 20, .kernel = {KernelShape::disk, 30}}};
    const Image plain = contact_sheet(stimuli);
    const Image figure = contact_sheet(stimuli, 3);
    EXPECT_EQ(plain.channels, 1);
    EXPECT_EQ(figure.width, 2 * plain.width);
    EXPECT_GT(figure.height, 2 * plain.height);  // it has a legend
}

TEST(ContactSheet, RefusesANumberOfContoursOutOfRange) {
    const std::vector<Stimulus> stimuli{{.texel_px = 20}};
    EXPECT_THROW(contact_sheet(stimuli, -1), InputError);
    EXPECT_THROW(contact_sheet(stimuli, kMostContours + 1), InputError);
    EXPECT_NO_THROW(contact_sheet(stimuli, kMostContours));
}

TEST(ContactSheet, DrawsContoursOfAnyEdgeInTime) {
    // A silhouette so steep that its height in the cell has no bounds, and one that is level.
    for (const double slope : {0.0, 3.0, 1e12}) {
        for (const double radius : {0.0, 40.0}) {
            const Stimulus edge{.pattern = Pattern::slope,
                                .silhouette = Pattern::slope,
                                .texel_px = 30,
                                .kernel = {KernelShape::disk, radius},
                                .slope = slope};
            EXPECT_EQ(contact_sheet({edge}, 3).channels, 3);
        }
    }
}

}  // namespace
}  // namespace stairstep
