// Writes many stimuli as images with their manifest, on several threads, and goes on where a killed run ended.
//
// An image's name appears by renaming alone (output_file.h), so an image that exists is whole, and its description says
// whether it is the one wanted. Files hold no time and no trace of threads: a run that was killed and resumed leaves
// the same bytes as one that was not.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "stimuli/draw.h"
#include "stimuli/io/manifest.h"
#include "stimuli/shard.h"
#include "stimuli/stimulus.h"

namespace stairstep {

struct Batch {
    std::filesystem::path folder;
    Rendition rendition{};
    /// Threads, 0 for one a core. Each holds one image at a time, and that is all the memory that images take.
    int jobs = 0;
    /// Which stimuli to write. With more than one part, the manifest names its part: stimuli.2-of-4.csv.
    Shard shard{};
    /// Keep the images that are there with the description they should have, and remove what a killed run left behind
    /// (of this part: others may be running).
    bool resume = false;
};

struct BatchSummary {
    size_t written = 0;
    size_t kept = 0;
    /// The manifest's name within the folder.
    std::string manifest;
};

/// luminance_of is called from several threads at once. Luminances of the source "exact" don't come from luminance_of: encode_exact draws them.
/// Throws InputError before anything is written where a stimulus is invalid or two have the same file name, and
/// FailureError where a file can't be written; images finished by then stay. The manifest, in the order of `stimuli`,
/// comes last: where a run in an empty folder has left one, every image it names is there.
BatchSummary write_batch(const std::vector<Stimulus>& stimuli, const Batch& batch, const LuminanceOf& luminance_of);

}  // namespace stairstep
