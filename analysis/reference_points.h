// The reference filter size of what a study showed, to draw beside what people need (Kreuzer 2017, figure 4.6).
#pragma once

#include <optional>
#include <vector>

#include "analysis/law_fit.h"

namespace stairstep {

/// The radius from which on artifact and line differ nowhere by more than one level of 255 (stimuli/reference.h).
struct ReferencePoint {
    ConditionName condition;
    double texel_px = 0;
    /// px; none where they differ still at the largest radius.
    std::optional<double> radius_px;
};

/// What the study's pictures were, where that isn't in its trials.
struct PictureSize {
    int width_px = 640;
    int height_px = 480;
};

/// Radii are sought up to this, px.
constexpr double kLargestReferenceRadius = 640;

/// One point a condition of the law and texel size of its thresholds, by condition, then by size. jobs: threads, 0 for one a core.
std::vector<ReferencePoint> reference_points(const LawFit& fit, const PictureSize& picture, int jobs);

}  // namespace stairstep
