// stimuli.csv: one row an image, in the grid's order. An image's own description says the same as its row.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stimuli/io/csv.h"
#include "stimuli/io/image_encoding.h"
#include "stimuli/io/stimulus_table.h"
#include "stimuli/stimulus.h"

namespace stairstep {

/// What all images of one run share.
struct Rendition {
    ImageEncoding encoding{};
    /// What made the luminances: "exact" or another way's name.
    std::string source = "exact";
    /// The viewing geometry, where it is known: pixels per degree of visual angle, > 0.
    std::optional<double> pixels_per_degree{};
};

/// Throws InputError for an encoding that doesn't exist or a viewing geometry out of range.
void require_valid(const Rendition& rendition);

/// The image file of a stimulus, relative to the manifest: its stem and the format's extension.
std::string image_file_name(const Stimulus& stimulus, ImageFormat format);

/// The description that the image carries: "pattern=step;kernel=box;…;pixels_per_degree=", all of the manifest's
/// columns but the file name.
std::string description(const Stimulus& stimulus, const Rendition& rendition);

/// Writes the manifest: file, the columns of a stimulus (stimulus_table.h), then source, transfer, bits, dither,
/// pixels_per_degree. Throws FailureError.
void write_manifest(const std::filesystem::path& path, std::span<const Stimulus> stimuli, const Rendition& rendition);

/// What a row of a manifest says. Columns after `bits` may be missing, as in manifests that have none.
struct ManifestEntry {
    std::string file;
    Stimulus stimulus;
    Rendition rendition;
};

/// Reads a row; a transfer's table is sought in `folder`. Throws InputError naming the row's line where it names no
/// stimulus, or a file other than the stimulus's.
ManifestEntry manifest_entry(const CsvTable& manifest, size_t row, const std::filesystem::path& folder);

}  // namespace stairstep
