// A stimulus: one picture that an observer judges, described completely by a value and drawn exactly.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "stimuli/edge.h"
#include "stimuli/kernel.h"

namespace stairstep {

/// How the reference line of a step runs: along the silhouette whose sampling made the step (slope a/W), or level.
enum class StepReference { sloped, horizontal };

std::string_view name(StepReference reference);

struct Stimulus {
    /// step, stair or slope: an artifact; line: the same silhouette without one.
    Pattern pattern = Pattern::step;
    /// step, stair or slope: for a line, whose silhouette it is; for an artifact, its own pattern.
    Pattern silhouette = Pattern::step;
    /// Side of a shadow-map texel on screen, px, > 0 (the artifact size a).
    double texel_px = 10;
    Kernel kernel{};
    /// C = L_lit in (0, 1]; the shadow is black: pixel value = C·V.
    double contrast = 1;
    int width_px = 640;
    int height_px = 480;
    StepReference step_reference = StepReference::sloped;
    /// m ≥ 0 of the silhouette y = m·x, for the pattern slope alone.
    double slope = 0;
    /// Where the texel grid lies, in texels; 0 is the pattern's own place. Lines have no grid and ignore it.
    Phase phase{};
};

/// Width and height lie in [1, kLargestSide] px: 16,384² is 2.1 GB as doubles, and GL textures end there too.
inline constexpr int kLargestSide = 16384;

/// Throws InputError and names the field that is out of its range.
void require_valid(const Stimulus& stimulus);

/// The edge that the stimulus shows.
Edge edge_of(const Stimulus& stimulus);

/// Centre of pixel column i, row j (row 0 on top) in the image frame.
Point pixel_centre(const Stimulus& stimulus, int column, int row);

/// Luminance C·V of every pixel at its centre, row by row from the top; width × height values in [0, C]. `draw` (draw.h)
/// makes pixels of other kinds, faster.
std::vector<double> luminance(const Stimulus& stimulus);

/// Nearest 8-bit level of a luminance in [0, 1]. Ties go up, and what lies within 10⁻⁹ of one is a tie: half a luminance of 1
/// is level 128 wherever rounding left the visibility at 1 − 10⁻¹⁶.
inline int level_8bit(double luminance) {
    return static_cast<int>(luminance * 255 + 0.5 + 1e-9);
}

/// A name that tells the stimulus apart, without extension: "step_box_a10_r35_c1", "line-of-stair_box_…".
std::string file_stem(const Stimulus& stimulus);

}  // namespace stairstep
