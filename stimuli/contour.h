// Iso-contours of visibility: a filtered shadow as the set of curves V = v (Kreuzer 2017, section 4.1.2 and figure 4.2). An
// edge that no shadow map has sampled has straight ones; where the filter's radius is too small for the texels they are
// uneven.
//
// Edges here never fall, so V never falls with y nor rises with x, and the contour of level v is a function that never
// falls:
//
//   y_v(x) = inf {y : V(x, y) ≥ v}
//
// It lies within the kernel's support around the edge and is found by halving, without a raster between. Where V jumps, as
// everywhere without a filter, the contours of all levels lie on the jump.
//
// Anchors (tests/stimuli/contour_test.cpp): y_½ of a line is the line itself under every symmetric kernel; under the box a
// level line has y_v = (2v − 1)·r, and a step of height a has y_v(x) = a·x/(2r) + (2v − 1)·r for |x| ≤ r while the kernel
// cuts both its treads.
#pragma once

#include <vector>

#include "stimuli/edge.h"
#include "stimuli/visibility.h"

namespace stairstep {

/// Most contours that may be asked for at once.
inline constexpr int kMostContours = 99;

/// `count` levels equally spaced between dark and lit: v_k = k/(count + 1), k = 1 … count. Throws InputError for a count
/// outside [1, kMostContours].
std::vector<double> contour_levels(int count);

/// y_v(x), px, to 10⁻⁹ px; `level` is v in (0, 1). A rotated poisson kernel is taken unturned.
double contour_height(const Edge& edge, const Filter& filter, double level, double x_px);

/// A part of the image frame, px.
struct Window {
    double left = 0;
    double right = 0;
    double bottom = 0;
    double top = 0;
};

/// The contour over the window's width, its points from left to right, both sides included. Where it passes through the
/// window neighbours are at most `spacing_px` apart along each axis, but for jumps: what happens within 10⁻³ px along x is
/// a single piece.
std::vector<Point> contour(const Edge& edge, const Filter& filter, double level, const Window& window,
                           double spacing_px);

}  // namespace stairstep
