#include "stimuli/reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(Reference, StairUnderABoxFollowsItsClosedForm) {
    // Numerics stay 0–4 % below (a/r)²/32, so the radius 0–2 % below 2.82·a·√C.
    for (const double texel : {5.0, 10.0}) {
        for (const double contrast : {1.0, 0.5}) {
            const Stimulus stair{
                .pattern = Pattern::stair, .silhouette = Pattern::stair, .texel_px = texel, .contrast = contrast};
            const double closed_form = texel * std::sqrt(255 * contrast / 32);
            const auto radius = reference_radius(stair, Likeness::one_level, 300);
            ASSERT_TRUE(radius);
            EXPECT_LE(*radius, closed_form * (1 + 1e-6));
            EXPECT_GE(*radius, 0.96 * closed_form) << texel << ' ' << contrast;
            // Half the level takes √2 the radius.
            EXPECT_NEAR(*reference_radius(stair, Likeness::half_level, 300) / *radius, std::sqrt(2), 0.03);
        }
    }
}

TEST(Reference, StepUnderABoxAndTheLevelLineFollowTheirClosedForm) {
    // a/(4r) of luminance at most, reached at the centre: r = 255·C·a/4. With a = 0.5 the picture still holds the place.
    const Stimulus step{
        .texel_px = 0.5, .contrast = 0.5, .width_px = 64, .height_px = 64, .step_reference = StepReference::horizontal};
    const auto radius = reference_radius(step, Likeness::one_level, 200);
    ASSERT_TRUE(radius);
    EXPECT_NEAR(*radius, 255 * 0.5 * 0.5 / 4, 0.6);
    EXPECT_FALSE(reference_radius({.texel_px = 20, .width_px = 64, .height_px = 64}, Likeness::one_level, 100));
}

TEST(Reference, IsTheLastCrossing) {
    for (const KernelShape shape : {KernelShape::box, KernelShape::disk, KernelShape::gaussian}) {
        const Stimulus stair{.pattern = Pattern::stair,
                             .silhouette = Pattern::stair,
                             .texel_px = 8,
                             .kernel = {shape},
                             .width_px = 160,
                             .height_px = 120};
        const auto radius = reference_radius(stair, Likeness::one_level, 120);
        ASSERT_TRUE(radius) << name(shape);
        EXPECT_GT(largest_difference(stair, *radius * (1 - 1e-4), false), 1);
        for (double r = *radius; r <= 120; r *= 1.013)
            EXPECT_LE(largest_difference(stair, r, false), 1) << name(shape) << r;
    }
}

TEST(Reference, RefusesLines) {
    EXPECT_THROW(largest_difference({.pattern = Pattern::line}, 10, false), InputError);
}

}  // namespace
}  // namespace stairstep
