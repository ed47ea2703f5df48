// Image files through OpenImageIO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace stairstep {

/// 8-bit pixels, row by row from the top, channels interleaved (1 grey, 3 RGB).
struct Image {
    int width = 0;
    int height = 0;
    int channels = 1;
    std::vector<uint8_t> pixels;

    Image() = default;
    Image(int width_px, int height_px, int channel_count)
        : width(width_px),
          height(height_px),
          channels(channel_count),
          pixels(static_cast<size_t>(width_px) * height_px * channel_count) {}

    uint8_t* at(int column, int row) { return &pixels[(static_cast<size_t>(row) * width + column) * channels]; }
    const uint8_t* at(int column, int row) const {
        return &pixels[(static_cast<size_t>(row) * width + column) * channels];
    }
};

/// Text attributes stored in an image file: name and value.
using ImageAttributes = std::vector<std::pair<std::string, std::string>>;

/// Writes a PNG, whole or not at all. Throws FailureError.
void write_png(const std::filesystem::path& path, const Image& image, const ImageAttributes& attributes = {});

/// Reads an image of any format OpenImageIO knows as 8-bit RGB or grey; alpha and further channels are
/// dropped. Throws InputError for a missing or damaged file, something that is no file, or a side above
/// `kLargestSide`.
Image read_image(const std::filesystem::path& path);

/// The same of a PNG, JPEG, BMP, GIF, TIFF, WebP or DDS file that lies in memory; `subject` names it in errors. What the
/// bytes start with says which it is.
Image decode_image(std::span<const uint8_t> bytes, const std::string& subject);

/// Draws a line of text in an image, its baseline's left end at (column, row). `grey` is the text's level.
/// Needs a DejaVu font; returns false where none is installed.
bool draw_text(Image& image, int column, int row, const std::string& text, int size_px, uint8_t grey);

}  // namespace stairstep
