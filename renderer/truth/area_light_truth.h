// The ground truth of soft shadows: how much of the light's square each pixel's surface sees, by tracing rays to it.
//
// The surface is the one nearest along the ray through the pixel's centre, as clip_from_world projects (view.h). Its
// visibility is
//
//   V = 1/n · Σ χ(s_i),   χ(s) = 1 where no caster lies between the surface and the point s of the square, else 0
//
// over n stratified points: the square is cut into √n × √n equal cells with one point in each, placed at random anew for
// each pixel. Where the square sees a straight edge, V is off by at most (2√n − 1)/n, by 1/√n if the edge lies along the
// square's sides; root mean square these are √(2√n)/(2n) and n^(−3/4)/2: 0.0039 and 0.0028 for n = 1,024.
//
// As in the shading, V = 1 where nothing is seen and V = 0 on a facet that faces away from the middle of the light, and
// outside a spot's cone. Surfaces are seen, and lit, from both sides.
//
// Anchors (tests/renderer/truth/area_light_truth_test.cpp): the penumbra of a straight edge is the box filter of its
// silhouette with light.h's half-widths; a point light's shadow is the caster's projection.
#pragma once

#include <vector>

#include "renderer/scene_state.h"

namespace stairstep {

/// Changes whenever the same arguments give other values, so that stored ones are known to be old.
inline constexpr int kAreaLightTruthVersion = 1;

inline constexpr int kTruthSamples = 1024;

/// Row by row from the top, each k/samples. width and height ≥ 1; samples is a square number ≥ 1. On `jobs` threads, 0 for
/// one a core; their number doesn't change a bit. Throws FailureError where Embree or the memory fails.
std::vector<float> area_light_visibility(const Scene& scene, const SceneState& state, int width, int height,
                                         int samples = kTruthSamples, int jobs = 0);

}  // namespace stairstep
