// Where a stimulus's shadow map lies and where its occluder goes: geometry alone, no GL.
//
// Texel space: x and y in texels of the map, texel (i, j) covering [i, i + 1) × [j, j + 1), as the texel grid of
// stimuli/edge.h lies: a pixel at (x, y) of the image frame is at (x/a − φx + ½, y/a − φy) less the map's first texel.
//
// The occluder is the half-plane below the silhouette. A texel gets dark if its centre lies below, and a centre on the
// silhouette stays lit. A rasteriser can't be told so: ties are its own affair, and it moves each vertex to a grid of
// 2^-GL_SUBPIXEL_BITS texels first, which turns the silhouette. So the occluder's edge is the silhouette lowered by half
// the distance to the centre next below, which puts it as far as can be from all centres, and it hangs on two points of
// the vertex grid where the two meet as well as they do anywhere.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "stimuli/stimulus.h"

namespace stairstep {

/// A pixel's place along one axis: the texel it lies in, and where in it, [0, 1]. Apart, both are exact as floats.
struct PlaceInTexel {
    float texel = 0;
    float within = 0;
};

struct HalfPlaneMap {
    int width = 1;
    int height = 1;
    /// The occluder's outline in texel space, counterclockwise; a triangle fan from its first point covers it.
    std::array<glm::dvec2, 5> occluder;
    /// Distance of a point from the occluder's edge, texels, positive on the lit side: x·p.x + y·p.y + z.
    glm::dvec3 edge;
    /// Of the centres of the image's columns, from the left, and rows, from the bottom.
    std::vector<PlaceInTexel> columns;
    std::vector<PlaceInTexel> rows;
};

/// Most texels along a side of the map: 256 MiB of depth.
inline constexpr int kLargestHalfPlaneMap = 8192;

/// Most texels that a kernel weighed texel by texel may be wide: 640×480 pixels of it take minutes of a CPU.
inline constexpr double kWidestStimulusKernel = 256;

/// The map for an artifact. It covers the image and the kernel's support around it. `vertex_grid` is 2^GL_SUBPIXEL_BITS.
///
/// The silhouette is y = m·x; a step's has the greatest slope that leaves one step in what the map covers: a over its width
/// where the design says a over the image's, since kernels reach beyond the image.
///
/// The map's texels are those of Edge exactly, unless a centre lies below the silhouette by less than about 10⁻⁴ texel: by
/// less than 2⁻⁹ where the slope is 0 or 1, and to its side by as little where the slope is in the hundreds.
///
/// Throws InputError for a line, which has no texels, for a map beyond kLargestHalfPlaneMap, and for a kernel beyond
/// kWidestStimulusKernel.
HalfPlaneMap half_plane_map(const Stimulus& stimulus, int vertex_grid);

}  // namespace stairstep
