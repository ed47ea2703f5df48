// A grid of stimuli: the product of patterns, texel sizes, radii and contrasts, in a fixed order.
#pragma once

#include <vector>

#include "stimuli/stimulus.h"

namespace stairstep {

struct StimulusGrid {
    /// `slope` stands for one of each of `slopes`; `line` for the line of each other pattern listed, or of step and stair
    /// when it is listed alone.
    std::vector<Pattern> patterns{Pattern::step, Pattern::stair, Pattern::line};
    std::vector<double> slopes;
    std::vector<double> texels_px{5, 10, 20, 30};
    std::vector<double> radii_px{0, 5, 10, 20, 35, 50, 70, 105};
    std::vector<KernelShape> kernels{KernelShape::box};
    /// For poisson: taps, seed and whether they are rotated.
    Kernel poisson{KernelShape::poisson};
    std::vector<double> contrasts{1, 0.5};
    /// For sampled patterns; lines have no grid and appear once.
    std::vector<Phase> phases{Phase{}};
    int width_px = 640;
    int height_px = 480;
    StepReference step_reference = StepReference::sloped;
};

/// Every stimulus of the grid once, patterns outermost, then kernel, contrast, texel size, radius and phase; each one
/// valid. Throws InputError for an empty axis, a value out of range, or one listed twice.
std::vector<Stimulus> stimuli_of(const StimulusGrid& grid);

}  // namespace stairstep
