// The reference filter size (Kreuzer 2017, section 4.4): the radius from which on a sampled edge looks exactly like its
// line, so that even a perfect observer could not tell them apart.
//
// Two pictures of the same size, kernel and contrast, C·V of artifact and line at every pixel centre. Their largest
// difference falls with the radius, under a disk not monotonically, so the answer is the last crossing.
//
// Anchors (tests/stimuli/reference_test.cpp), from the closed forms for the box: a stair and its line are within one level
// of 255 from r = a·√(255·C/32) = 2.82·a·√C on, a step and the level line from r = 255·C·a/4 ≈ 64·a·C.
#pragma once

#include <optional>

#include "stimuli/stimulus.h"

namespace stairstep {

/// When two pictures count as alike.
enum class Likeness {
    /// No pixel differs by more than one level of 255, before rounding.
    one_level,
    /// … by more than half a level.
    half_level,
    /// Rounded to 8 bits, no pixel differs at all.
    identical
};

/// Largest difference between an artifact and its line, in levels of 255; `rounded` after rounding both to 8 bits. The
/// stimulus gives all but the radius. Throws InputError where it is no artifact.
double largest_difference(const Stimulus& artifact, double radius_px, bool rounded);

/// The smallest radius, px, from which on artifact and line are alike up to `largest_radius_px`; nullopt where they differ
/// there still. The last crossing is bracketed by steps of 2 %, then halved to 10⁻⁶ of itself; for `identical` the
/// differences come and go from pixel to pixel and the steps may pass over one.
std::optional<double> reference_radius(const Stimulus& artifact, Likeness likeness, double largest_radius_px);

}  // namespace stairstep
