// From luminance to the levels that an integer image stores.
//
// Without dither each pixel takes the level nearest to its encoded value; ties, to 10⁻⁹ of a level, go up. With dither a pixel takes the
// level below or above, so that a neighbourhood shows the luminance that no single level has. What dither keeps is the
// mean luminance as displayed, not the mean stored value: under a curved transfer the two differ.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "stimuli/transfer.h"

namespace stairstep {

///  none: nearest level
///  ordered: against the 8 × 8 Bayer matrix, the mean of a uniform field within 1/128 of the step between two levels
///  error_diffusion: Floyd & Steinberg (1976) on a serpentine; what would leave the image at a side goes straight down
enum class Dither { none, ordered, error_diffusion };

std::string_view name(Dither dither);
std::optional<Dither> dither_named(std::string_view name);

/// The level 0 … 2^bits − 1 nearest to a luminance in [0, 1] once encoded; a greater luminance never has a smaller one.
double nearest_level(double luminance, const Transfer& transfer, int bits);

/// The levels 0 … 2^bits − 1 of a picture with rows of `width` luminances in [0, 1]; a function of its arguments alone.
/// bits is 8 or 16. As floats, which hold these integers exactly.
std::vector<float> quantise(std::span<const double> luminance, int width, const Transfer& transfer, int bits,
                            Dither dither);

}  // namespace stairstep
