#include "stimuli/io/verification.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stimuli/error.h"
#include "stimuli/io/progress.h"
#include "stimuli/parallel.h"

namespace stairstep {
namespace fs = std::filesystem;
namespace {

std::optional<ImageFault> fault_of(const ManifestEntry& entry, const fs::path& path, const LuminanceOf& luminance_of) {
    ImageFault fault{entry.file, "", 0, 0};
    const auto with = [&fault](const char* problem) {
        fault.problem = problem;
        return fault;
    };
    if (!fs::is_regular_file(path)) return with("missing");
    StoredImage stored;
    try {
        stored = read_stored_image(path);
    } catch (const InputError&) {
        return with("unreadable");
    }
    const StoredImage expected = encode(entry.stimulus, luminance_of(entry.stimulus), entry.rendition.encoding);
    const auto shape = [](const StoredImage& image) { return std::tuple(image.width_px, image.height_px, image.bits); };
    if (shape(stored) != shape(expected)) return with("another shape");

    for (size_t i = 0; i < stored.values.size(); ++i) {
        // NaN equals nothing, and so counts as different.
        if (stored.values[i] == expected.values[i]) continue;
        ++fault.pixels;
        const double difference = std::abs(double{stored.values[i]} - expected.values[i]);
        fault.largest_difference = std::isnan(difference) ? INFINITY : std::max(fault.largest_difference, difference);
    }
    if (fault.pixels > 0) return with("other pixels");
    if (stored_description(path) != description(entry.stimulus, entry.rendition)) return with("another description");
    return std::nullopt;
}

}  // namespace

Verification verify(const fs::path& folder, int jobs,
                    const std::function<LuminanceOf(const std::string& source)>& luminance_by) {
    const CsvTable manifest = CsvTable::read(folder / "stimuli.csv");
    std::vector<std::optional<ImageFault>> faults(manifest.row_count());
    Progress progress("verifying", static_cast<long>(manifest.row_count()));
    run_in_parallel(manifest.row_count(), jobs, [&](size_t row) {
        const ManifestEntry entry = manifest_entry(manifest, row, folder);
        faults[row] = fault_of(entry, folder / entry.file, luminance_by(entry.rendition.source));
        progress.advance();
    });
    Verification result{manifest.row_count(), {}};
    for (auto& fault : faults) {
        if (fault) result.faults.push_back(std::move(*fault));
    }
    return result;
}

}  // namespace stairstep
