// A contact sheet: many stimuli in one picture, texel sizes down, radii across, so that the law can be seen: steps
// vanish along a diagonal, where the radius is the same multiple of the texel.
#pragma once

#include <vector>

#include "stimuli/io/image_file.h"
#include "stimuli/stimulus.h"

namespace stairstep {

/// Draws the artifacts among `stimuli`, at most ten of their radii, one block of rows a pattern; contrast and kernel
/// are those of the first. Each cell shows the middle of its stimulus, halved in size (which leaves r/a, and so the law,
/// unchanged), and names r in texels. Throws InputError where there is no artifact among them.
Image contact_sheet(const std::vector<Stimulus>& stimuli);

}  // namespace stairstep
