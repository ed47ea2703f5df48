// stimuli.csv: one row an image, in the grid's order.
#pragma once

#include <filesystem>
#include <vector>

#include "stimuli/stimulus.h"

namespace stairstep {

/// The image file of a stimulus, relative to the manifest: its stem and ".png".
std::string image_file_name(const Stimulus& stimulus);

/// Writes the manifest with the columns file, pattern, kernel, contrast, texel_px, radius_px, width_px, height_px,
/// silhouette (whose line a line is), step_reference, source, transfer, bits. Throws FailureError.
/// `source` made the artifacts, "exact" or "shadow-map"; lines are exact always.
void write_manifest(const std::filesystem::path& path, const std::vector<Stimulus>& stimuli,
                    const std::string& source = "exact");

}  // namespace stairstep
