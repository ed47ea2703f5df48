#include "stimuli/io/image_encoding.h"

#include <algorithm>

#include "stimuli/draw.h"
#include "stimuli/error.h"

namespace stairstep {

std::string_view name(ImageFormat format) {
    switch (format) {
        case ImageFormat::png: return "png";
        case ImageFormat::tif: return "tif";
        case ImageFormat::exr: return "exr";
    }
    return "";
}

std::optional<ImageFormat> image_format_named(std::string_view text) {
    for (const ImageFormat format : {ImageFormat::png, ImageFormat::tif, ImageFormat::exr}) {
        if (name(format) == text) return format;
    }
    return std::nullopt;
}

void require_valid(const ImageEncoding& encoding) {
    const bool is_float = encoding.format == ImageFormat::exr;
    const std::string format(name(encoding.format));
    const bool has_depth = is_float ? encoding.bits == 32 : encoding.bits == 8 || encoding.bits == 16;
    if (!has_depth) {
        throw InputError("--bits", format + " can't hold " + std::to_string(encoding.bits) + " bits a pixel",
                         is_float ? "use --bits 32" : "use --bits 8 or 16, or --format exr for 32");
    }
    if (is_float && encoding.dither != Dither::none) {
        throw InputError("--dither", "exr holds floats, which need none", "use --dither none");
    }
}

StoredImage encode(const Stimulus& stimulus, std::span<const double> luminance, const ImageEncoding& encoding) {
    StoredImage image{stimulus.width_px, stimulus.height_px, encoding.bits, {}};
    if (encoding.format != ImageFormat::exr) {
        image.values = quantise(luminance, stimulus.width_px, encoding.transfer, encoding.bits, encoding.dither);
        return image;
    }
    image.values.resize(luminance.size());
    std::transform(luminance.begin(), luminance.end(), image.values.begin(),
                   [&](double value) { return static_cast<float>(encoding.transfer.encode(value)); });
    return image;
}

StoredImage encode_exact(const Stimulus& stimulus, const ImageEncoding& encoding) {
    if (encoding.dither != Dither::none || encoding.format == ImageFormat::exr) {
        return encode(stimulus, luminance(stimulus), encoding);
    }
    const auto quantise = [&](double value) { return nearest_level(value, encoding.transfer, encoding.bits); };
    return {stimulus.width_px, stimulus.height_px, encoding.bits, draw<float>(stimulus, quantise)};
}

}  // namespace stairstep
