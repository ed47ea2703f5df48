// Checks that images are still what their manifest says: every one is derived again and compared, value by value.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "stimuli/io/batch.h"

namespace stairstep {

/// What is wrong with an image.
struct ImageFault {
    std::string file;
    /// "missing", "unreadable", "another shape" (size or depth), "another description" or "other pixels"
    std::string problem;
    /// Of other pixels: how many, and by how much at most, in levels or for floats in stored values.
    size_t pixels = 0;
    double largest_difference = 0;
};

struct Verification {
    size_t images = 0;
    /// In the manifest's order.
    std::vector<ImageFault> faults;
};

/// Compares every image that folder/stimuli.csv lists, on `jobs` threads (0: one a core). `luminance_by` gives a
/// source's luminances by its name and throws InputError for an unknown one. Throws InputError for a manifest that is
/// missing or no manifest.
Verification verify(const std::filesystem::path& folder, int jobs,
                    const std::function<LuminanceOf(const std::string& source)>& luminance_by);

}  // namespace stairstep
