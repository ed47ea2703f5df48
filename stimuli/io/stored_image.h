// Images of one channel with the very values a file stores, at each depth that stimuli come in; image_file.h is for
// 8-bit pictures to look at.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stairstep {

struct StoredImage {
    int width_px = 0;
    int height_px = 0;
    /// 8 or 16: values are the integers 0 … 2^bits − 1, which floats hold exactly. 32: values are any floats.
    int bits = 8;
    /// Row by row from the top.
    std::vector<float> values;

    bool operator==(const StoredImage&) const = default;
};

/// Writes a .png or .tif of 8 or 16 bits or an .exr of 32, by the path's extension, whole or not at all. The
/// description becomes the file's ImageDescription. The same arguments always give the same bytes: no time is stored.
/// Throws FailureError.
void write_stored_image(const std::filesystem::path& path, const StoredImage& image, const std::string& description);

/// Reads what `write_stored_image` wrote. Throws InputError for a file that is missing, damaged, of another depth or of
/// several channels, or with a side above `kLargestSide`.
StoredImage read_stored_image(const std::filesystem::path& path);

/// The description in an image's header; nullopt where there is no such file, it is no image, or it has none.
std::optional<std::string> stored_description(const std::filesystem::path& path);

}  // namespace stairstep
