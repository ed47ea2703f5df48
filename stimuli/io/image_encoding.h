// How a stimulus's luminance becomes the values of a file.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "stimuli/io/stored_image.h"
#include "stimuli/quantise.h"
#include "stimuli/stimulus.h"
#include "stimuli/transfer.h"

namespace stairstep {

/// png and tif hold integers of 8 or 16 bits, exr floats of 32.
enum class ImageFormat { png, tif, exr };

/// Also the file's extension.
std::string_view name(ImageFormat format);
std::optional<ImageFormat> image_format_named(std::string_view name);

struct ImageEncoding {
    ImageFormat format = ImageFormat::png;
    int bits = 8;
    Transfer transfer{};
    /// For integers alone.
    Dither dither = Dither::none;
};

/// Throws InputError where the format has no such depth, or floats are to be dithered.
void require_valid(const ImageEncoding& encoding);

/// The values to store for a stimulus's luminances: levels for integers, the transfer's result for floats.
StoredImage encode(const Stimulus& stimulus, std::span<const double> luminance, const ImageEncoding& encoding);

/// encode() of the exact luminance, without computing what rounding makes equal: many times as fast where there is no
/// dither.
StoredImage encode_exact(const Stimulus& stimulus, const ImageEncoding& encoding);

}  // namespace stairstep
