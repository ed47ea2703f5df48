// The stimuli's closed forms against what a shadow map does.
#include "renderer/stimulus_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <thread>

#include "renderer/gl/context.h"
#include "renderer/half_plane_map.h"
#include "renderer/stimulus_source.h"
#include "stimuli/error.h"
#include "stimuli/grid.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

constexpr int kWidth = 128;
constexpr int kHeight = 96;
/// What adding up thousands of texels' weights as floats leaves. Levels flip where the exact value is nearly a tie, as ½ is;
/// but weights that are 1 % off would flip no more than a level either, and this tells.
constexpr double kRounding = 2e-5;

/// How far two pictures of the same stimuli are apart.
struct Difference {
    int worst_levels = 0;
    double worst_luminance = 0;
    long pixels = 0;
    /// By one level or more.
    long differing = 0;
    /// Neither black nor lit.
    long grey = 0;
    std::string worst_stimulus;

    void add(const Stimulus& stimulus, const std::vector<double>& drawn, const std::vector<double>& exact) {
        ASSERT_EQ(drawn.size(), exact.size());
        for (size_t i = 0; i < drawn.size(); ++i) {
            const int levels = std::abs(level_8bit(drawn[i]) - level_8bit(exact[i]));
            worst_luminance = std::max(worst_luminance, std::abs(drawn[i] - exact[i]));
            differing += levels > 0;
            grey += exact[i] > 0 && exact[i] < stimulus.contrast;
            if (levels <= worst_levels) continue;
            worst_levels = levels;
            worst_stimulus = file_stem(stimulus);
        }
        pixels += static_cast<long>(drawn.size());
    }
};

std::ostream& operator<<(std::ostream& out, const Difference& difference) {
    return out << "worst " << difference.worst_levels << " levels, " << difference.worst_luminance
               << " of luminance; pixels that differ: "
               << format_fixed(1e6 * difference.differing / difference.pixels, 1) << " in 10⁶ of " << difference.pixels
               << ", " << format_fixed(100.0 * difference.grey / difference.pixels, 0) << " % grey "
               << difference.worst_stimulus;
}

class StimulusRendererTest : public testing::Test {
  protected:
    Difference difference_over(const std::vector<Stimulus>& stimuli) {
        Difference difference;
        for (const Stimulus& stimulus : stimuli) {
            difference.add(stimulus, renderer_.luminance(stimulus), luminance(stimulus));
        }
        return difference;
    }

    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
    StimulusRenderer renderer_;
};

struct Silhouette {
    Pattern pattern;
    double slope;
};

constexpr Silhouette kSilhouettes[]{
    {Pattern::step, 0}, {Pattern::stair, 0}, {Pattern::slope, 0.3}, {Pattern::slope, 0.77}};
/// Their own place; ties on the stair's silhouette; and anywhere.
constexpr Phase kPhases[]{{0, 0}, {0.5, 0}, {0.31, -0.17}};

std::vector<Stimulus> grid_of(const Kernel& kernel, const std::vector<double>& texels_px) {
    std::vector<Stimulus> stimuli;
    for (const auto& [pattern, slope] : kSilhouettes) {
        for (const double texel_px : texels_px) {
            for (const double radius_px : {0.0, 2.0, texel_px, 17.5, 3.47 * texel_px, 105.0}) {
                for (const Phase& phase : kPhases) {
                    Stimulus stimulus{.pattern = pattern,
                                      .silhouette = pattern,
                                      .texel_px = texel_px,
                                      .kernel = kernel,
                                      .width_px = kWidth,
                                      .height_px = kHeight,
                                      .slope = slope,
                                      .phase = phase};
                    stimulus.kernel.radius_px = radius_px;
                    stimuli.push_back(stimulus);
                }
            }
        }
    }
    return stimuli;
}

TEST_F(StimulusRendererTest, BoxDiskAndGaussianAreWithinALevelEverywhere) {
    for (const KernelShape shape : {KernelShape::box, KernelShape::disk, KernelShape::gaussian}) {
        const Difference difference = difference_over(grid_of({shape}, {5, 7.5, 30}));
        std::cout << name(shape) << ": " << difference << "\n";
        EXPECT_LE(difference.worst_levels, 1) << name(shape) << ": " << difference;
        EXPECT_LT(difference.worst_luminance, kRounding) << name(shape) << ": " << difference;
        EXPECT_GT(difference.grey, difference.pixels / 20) << "the pictures should show penumbras";
    }
}

// A tap's place has rounding of some 1e-6 texel as a float; where it falls on a texel's border it may count on either side.
TEST_F(StimulusRendererTest, PoissonIsOffByATapWhereATapFallsOnABorder) {
    for (const bool rotated : {false, true}) {
        const Kernel kernel{.shape = KernelShape::poisson, .taps = 25, .seed = 3, .rotated = rotated};
        const Difference difference = difference_over(grid_of(kernel, {5, 7.5, 30}));
        std::cout << (rotated ? "poisson rotated: " : "poisson fixed: ") << difference << "\n";
        EXPECT_LE(difference.worst_luminance, 1.0 / 25 + 1e-6) << difference;
        EXPECT_LE(difference.differing, difference.pixels / 100'000) << difference;
    }
}

TEST_F(StimulusRendererTest, TheThesisGridAgreesInEveryPixel) {
    for (const KernelShape shape : {KernelShape::box, KernelShape::disk}) {
        StimulusGrid grid;
        grid.patterns = {Pattern::step, Pattern::stair};
        grid.kernels = {shape};
        grid.contrasts = {1};
        const Difference difference = difference_over(stimuli_of(grid));
        std::cout << name(shape) << ", 640x480: " << difference << "\n";
        EXPECT_LE(difference.worst_levels, 1) << difference;
        EXPECT_LT(difference.worst_luminance, kRounding) << difference;
    }
}

// What the bounds above are worth: a grid half a texel off, a radius 1 %, or another kernel is far outside them.
TEST_F(StimulusRendererTest, SmallErrorsWouldShow) {
    const Stimulus stimulus{.kernel = {KernelShape::disk, 35}, .width_px = kWidth, .height_px = kHeight};
    const std::vector<double> drawn = renderer_.luminance(stimulus);
    for (const auto& spoil : std::vector<void (*)(Stimulus&)>{
             [](Stimulus& s) { s.phase.x = 0.5; }, [](Stimulus& s) { s.phase.y = 0.5; },
             [](Stimulus& s) { s.kernel.radius_px = 35.35; }, [](Stimulus& s) { s.kernel.shape = KernelShape::box; }}) {
        Stimulus other = stimulus;
        spoil(other);
        Difference difference;
        difference.add(other, drawn, luminance(other));
        EXPECT_GT(difference.worst_luminance, 1e-3) << difference;
    }
}

TEST_F(StimulusRendererTest, SilhouettesOfAnySlopeLeaveTheirTexels) {
    // Unfiltered, pictures show the map's texels as they are; wherever one is wrong, a level is off by 255.
    for (const double slope : {0.0, 0.013, 0.5, 1.0 / 3, 0.999, 1.0, 1.5, 4.25, 97.0}) {
        for (const Phase& phase : {Phase{0, 0}, Phase{0.5, 0}, Phase{0.31, -0.17}, Phase{12.375, -3.25}}) {
            for (const double texel_px : {0.9, 5.0, 41.0}) {
                const Stimulus stimulus{.pattern = Pattern::slope,
                                        .silhouette = Pattern::slope,
                                        .texel_px = texel_px,
                                        .width_px = kWidth,
                                        .height_px = kHeight,
                                        .slope = slope,
                                        .phase = phase};
                const Difference difference = difference_over({stimulus});
                EXPECT_EQ(difference.differing, 0) << difference;
            }
        }
    }
}

TEST_F(StimulusRendererTest, AStepIsOneWhereverItStands) {
    for (const Phase& phase : {Phase{0, 0}, Phase{-7, 3}, Phase{90, 0}, Phase{0, 40}, Phase{0, -40}}) {
        const Stimulus stimulus{
            .texel_px = 5, .kernel = {KernelShape::box, 30}, .width_px = kWidth, .height_px = kHeight, .phase = phase};
        const Difference difference = difference_over({stimulus});
        EXPECT_LE(difference.worst_levels, 1) << difference;
    }
}

TEST(ShadowMapSource, ManyThreadsGetTheirPictures) {
    const LuminanceOf source = shadow_map_source();
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&source, i] {
            for (const double radius_px : {3.0 + i, 20.0 + i}) {
                const Stimulus stimulus{.kernel = {KernelShape::box, radius_px}, .width_px = 64, .height_px = 48};
                Difference difference;
                difference.add(stimulus, source(stimulus), luminance(stimulus));
                EXPECT_LE(difference.worst_levels, 1) << difference;
            }
        });
    }
}

TEST(ShadowMapSource, LinesAreExactAndErrorsReachTheCaller) {
    const LuminanceOf source = shadow_map_source();
    const Stimulus line{.pattern = Pattern::line, .kernel = {KernelShape::disk, 9}, .width_px = 64, .height_px = 48};
    EXPECT_EQ(source(line), luminance(line));
    EXPECT_THROW(source({.kernel = {KernelShape::box, 1e300}}), InputError);
    EXPECT_NO_THROW(source({.width_px = 8, .height_px = 8})) << "and the next stimulus is drawn";
}

TEST(HalfPlaneMap, CoversTheImageAndTheKernelAroundIt) {
    const Stimulus stimulus{.pattern = Pattern::stair, .texel_px = 10, .kernel = {KernelShape::gaussian, 40}};
    const HalfPlaneMap map = half_plane_map(stimulus, 256);
    ASSERT_EQ(map.columns.size(), 640u);
    ASSERT_EQ(map.rows.size(), 480u);
    EXPECT_GE(map.columns.front().texel, 6);
    EXPECT_GE(map.rows.front().texel, 6);
    EXPECT_LE(map.columns.back().texel + 6, map.width);
    EXPECT_LE(map.rows.back().texel + 6, map.height);
}

TEST(HalfPlaneMap, HangsItsEdgeOnTheVertexGrid) {
    const Stimulus stimulus{.pattern = Pattern::slope, .silhouette = Pattern::slope, .slope = 0.7215};
    const HalfPlaneMap map = half_plane_map(stimulus, 256);
    for (const glm::dvec2& point : map.occluder) {
        EXPECT_EQ(point, glm::round(point * 256.0) / 256.0);
    }
    for (const size_t end : {2, 3}) {
        EXPECT_NEAR(glm::dot(map.edge, glm::dvec3(map.occluder[end], 1)), 0, 1e-5) << "as the silhouette runs";
    }
}

TEST(HalfPlaneMap, RefusesWhatHasNoMap) {
    Stimulus line{.pattern = Pattern::line};
    EXPECT_THROW(half_plane_map(line, 256), InputError);
    for (const double radius_px : {1300.0, 1e5, 1e300}) {
        EXPECT_THROW(half_plane_map({.kernel = {KernelShape::box, radius_px}}, 256), InputError);
    }
    EXPECT_NO_THROW(half_plane_map({.kernel = {KernelShape::poisson, 1300}}, 256)) << "taps cost the same anywhere";
    EXPECT_THROW(half_plane_map({.kernel = {KernelShape::poisson, 1e5}}, 256), InputError);
    EXPECT_THROW(half_plane_map({.texel_px = 1e-3}, 256), InputError);
}

}  // namespace
}  // namespace stairstep
