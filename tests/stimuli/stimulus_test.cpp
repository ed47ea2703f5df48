#include "stimuli/stimulus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "stimuli/draw.h"
#include "stimuli/error.h"
#include "stimuli/visibility.h"

namespace stairstep {
namespace {

TEST(Stimulus, PixelCentresFollowTheImageFrame) {
    const Stimulus s{.width_px = 640, .height_px = 480};
    EXPECT_EQ(pixel_centre(s, 0, 0).x, -319.5);
    EXPECT_EQ(pixel_centre(s, 0, 0).y, 239.5);
    EXPECT_EQ(pixel_centre(s, 639, 479).x, 319.5);
    EXPECT_EQ(pixel_centre(s, 639, 479).y, -239.5);
}

TEST(Stimulus, UnfilteredStepIsBlackBelowAndContrastAbove) {
    Stimulus s{.texel_px = 10, .contrast = 0.5, .width_px = 64, .height_px = 48};
    const std::vector<double> pixels = luminance(s);
    ASSERT_EQ(pixels.size(), 64u * 48u);
    for (int row = 0; row < 48; ++row) {
        for (int column = 0; column < 64; ++column) {
            const double edge = column < 32 ? -5 : 5;
            const double expected = 24 - row - 0.5 > edge ? 0.5 : 0;
            EXPECT_EQ(pixels[row * 64 + column], expected) << column << ", " << row;
        }
    }
}

TEST(Stimulus, HalfOfAnImageIsLit) {
    // The silhouette runs through the centre, so mean luminance is C/2 for each pattern and radius that fits.
    for (const Pattern pattern : {Pattern::step, Pattern::stair, Pattern::line}) {
        for (const double radius : {0.0, 8.0, 20.0}) {
            Stimulus s{.pattern = pattern,
                       .kernel = {KernelShape::box, radius},
                       .contrast = 0.8,
                       .width_px = 120,
                       .height_px = 120};
            if (pattern == Pattern::stair) s.silhouette = Pattern::stair;
            double sum = 0;
            for (const double value : luminance(s)) sum += value / (120 * 120);
            EXPECT_NEAR(sum, 0.4, 1e-9) << name(pattern) << " r " << radius;
        }
    }
}

TEST(Stimulus, LineOfAStepRunsAlongTheSilhouetteOrLevel) {
    Stimulus s{.pattern = Pattern::line, .texel_px = 16, .width_px = 640};
    EXPECT_EQ(edge_of(s).height(320), 8);  // a/W·W/2
    s.step_reference = StepReference::horizontal;
    EXPECT_EQ(edge_of(s).height(320), 0);
    s.silhouette = Pattern::stair;
    EXPECT_EQ(edge_of(s).height(320), 320);
}

TEST(Stimulus, LevelsRoundToNearest) {
    EXPECT_EQ(level_8bit(0), 0);
    EXPECT_EQ(level_8bit(1), 255);
    EXPECT_EQ(level_8bit(0.5), 128);  // 127.5: a tie goes up
    EXPECT_EQ(level_8bit(100.49 / 255), 100);
    EXPECT_EQ(level_8bit(100.51 / 255), 101);
}

TEST(Stimulus, FileStemsTellStimuliApart) {
    std::set<std::string> stems;
    for (const double texel : {5.0, 5.5, 10.0}) {
        for (const double radius : {0.0, 17.5, 1e-7, 0.1 + 0.2}) {
            for (const Pattern pattern : {Pattern::step, Pattern::line}) {
                stems.insert(file_stem({.pattern = pattern, .texel_px = texel, .kernel = {KernelShape::box, radius}}));
            }
        }
    }
    EXPECT_EQ(stems.size(), 3u * 4u * 2u);
    EXPECT_EQ(file_stem({.kernel = {KernelShape::box, 17.5}}), "step_box_a10_r17.5_c1");
}

TEST(Stimulus, RefusesValuesOutOfRange) {
    const Stimulus good;
    EXPECT_NO_THROW(require_valid(good));
    for (const auto& spoil : std::vector<void (*)(Stimulus&)>{
             [](Stimulus& s) { s.texel_px = 0; }, [](Stimulus& s) { s.texel_px = NAN; },
             [](Stimulus& s) { s.kernel.radius_px = -1; }, [](Stimulus& s) { s.kernel.radius_px = INFINITY; },
             [](Stimulus& s) { s.contrast = 0; }, [](Stimulus& s) { s.contrast = 1.01; },
             [](Stimulus& s) { s.width_px = 0; }, [](Stimulus& s) { s.height_px = 1'000'000'000; },
             [](Stimulus& s) { s.silhouette = Pattern::line; }}) {
        Stimulus bad;
        spoil(bad);
        EXPECT_THROW(require_valid(bad), InputError);
    }
}

/// Compares a stimulus drawn by halves and copies with the filter pixel by pixel.
void expect_pointwise(const Stimulus& s) {
    const std::vector<double> pixels = luminance(s);
    const std::vector<uint8_t> levels = draw<uint8_t>(s, level_8bit);
    const Filter filter(s.kernel);
    for (int row = 0; row < s.height_px; ++row) {
        for (int column = 0; column < s.width_px; ++column) {
            const bool rotated = s.kernel.shape == KernelShape::poisson && s.kernel.rotated;
            const double rotation = rotated ? rotation_at(column, row, s.kernel.seed) : 0;
            const double v = filter.visibility(edge_of(s), pixel_centre(s, column, row), rotation);
            const size_t i = static_cast<size_t>(row) * s.width_px + column;
            ASSERT_NEAR(pixels[i], s.contrast * v, 1e-13) << file_stem(s) << " at " << column << ", " << row;
            ASSERT_EQ(levels[i], level_8bit(s.contrast * v)) << file_stem(s) << " at " << column << ", " << row;
        }
    }
}

TEST(Stimulus, WhatSymmetryCopiesIsWhatThePointwiseFilterGives) {
    for (const Pattern pattern : {Pattern::stair, Pattern::line, Pattern::step, Pattern::slope}) {
        for (const Pattern silhouette : {Pattern::step, Pattern::stair, Pattern::slope}) {
            if (pattern != Pattern::line && pattern != silhouette) continue;
            for (const KernelShape shape :
                 {KernelShape::box, KernelShape::disk, KernelShape::gaussian, KernelShape::poisson}) {
                for (const double texel : {4.0, 5.0, 7.5, 40.0}) {
                    for (const double slope : {0.5, 1.0, 0.37, 1.5}) {
                        if (silhouette != Pattern::slope && slope != 1) continue;
                        expect_pointwise({.pattern = pattern,
                                          .silhouette = silhouette,
                                          .texel_px = texel,
                                          .kernel = {.shape = shape, .radius_px = 17.5, .rotated = texel == 40},
                                          .contrast = 0.5,
                                          .width_px = 60,
                                          .height_px = 48,
                                          .slope = slope,
                                          .phase = {0.25, 0.5}});
                    }
                }
            }
        }
    }
}

TEST(Stimulus, EdgesOfRationalSlopeRepeat) {
    const auto period = [](const Stimulus& s) {
        const Translation t = StimulusSampler(s).period();
        return std::pair(t.right, t.up);
    };
    EXPECT_EQ(period({.pattern = Pattern::line, .texel_px = 30, .width_px = 640}), std::pair(64, 3));
    EXPECT_EQ(period({.pattern = Pattern::stair, .silhouette = Pattern::stair, .texel_px = 20}), std::pair(20, 20));
    EXPECT_EQ(period({.pattern = Pattern::stair, .silhouette = Pattern::stair, .texel_px = 7.5}), std::pair(15, 15));
    EXPECT_EQ(period({.pattern = Pattern::slope, .silhouette = Pattern::slope, .texel_px = 10, .slope = 0.5}),
              std::pair(20, 10));
    EXPECT_EQ(period({.pattern = Pattern::step, .texel_px = 10}), std::pair(0, 0));
}

}  // namespace
}  // namespace stairstep
