// What a picture of a stage should hold, pixel by pixel.
//
//   point    1 where the light's middle is in sight
//   area     the share of the light's square that is in sight
//   filter   the box filter of half-width r over the light plane: the mean of `point` over the receiver's own plane, where that
//            is under the box around the receiver
//
// Each share is the mean over n × n midpoints, n = 20: across one straight edge it is off by 1/(2n) at most. As in the shading,
// 1 where nothing is seen and 0 on facets turned away and outside a spot's cone. On facets that the light meets at a cosine below
// 1e-6 there is none to see or to miss: NaN.
#pragma once

#include <vector>

#include "renderer/stress/stage.h"

namespace stairstep::stress {

enum class TruthOf { point, area, filter };

/// Row by row from the top; `radius` is a length in the light plane (light_frustum.h) at home, ≥ 0. On one thread a core.
std::vector<float> true_visibility(const Stage& stage, TruthOf kind, double radius, int width, int height);

/// Pixels that see certain light, given their true visibility: lit, the same face as all eight around them, and no shadow
/// within `margin` (light plane, at home) of all that a filter may look at. Any darkness there is acne. Shadows are looked for at
/// points no further apart than the stage's shadows are wide.
std::vector<bool> clear_pixels(const Stage& stage, TruthOf kind, double radius, double margin,
                               const std::vector<float>& visibility, int width, int height);

}  // namespace stairstep::stress
