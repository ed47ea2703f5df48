// A contact sheet: many stimuli in one picture, texel sizes down, radii across, so that the law can be seen: steps
// vanish along a diagonal, where the radius is the same multiple of the texel.
//
// With contours it is a figure of its own, after Kreuzer (2017), figure 4.2: over pale shading the iso-contours of the
// artifact's visibility, thin and dark, and under each the one its line would have, broad and coloured. Where the filter
// hides the texels the dark curve runs along the middle of the coloured one; where it doesn't, it leaves it.
#pragma once

#include <vector>

#include "stimuli/io/image_file.h"
#include "stimuli/stimulus.h"

namespace stairstep {

/// Draws the artifacts among `stimuli`, at most ten of their radii, one block of rows a pattern; contrast and kernel
/// are those of the first. Each cell shows the middle of its stimulus, halved in size (which leaves r/a, and so the law,
/// unchanged), and names r in texels. Throws InputError where there is no artifact among them.
///
/// With contours, of V = 1/(n + 1) … n/(n + 1) for n in [1, kMostContours] (contour.h), the sheet is RGB and twice as wide
/// and high: cells are pixel for pixel. 0 draws none; throws InputError for any other number.
Image contact_sheet(const std::vector<Stimulus>& stimuli, int contours = 0);

}  // namespace stairstep
