#include "stimuli/io/batch.h"

#include <algorithm>
#include <atomic>
#include <unordered_set>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/progress.h"
#include "stimuli/io/transfer_file.h"
#include "stimuli/parallel.h"

namespace stairstep {
namespace fs = std::filesystem;
namespace {

void require_distinct_names(const std::vector<Stimulus>& stimuli) {
    std::unordered_set<std::string> stems;
    for (const Stimulus& stimulus : stimuli) {
        require_valid(stimulus);
        const std::string stem = file_stem(stimulus);
        if (!stems.insert(stem).second) {
            throw InputError("grid", "has two stimuli of the same file name " + stem, "write them to two folders");
        }
    }
}

std::string manifest_name(const Shard& shard) {
    if (shard.count == 1) return "stimuli.csv";
    return "stimuli." + std::to_string(shard.index) + "-of-" + std::to_string(shard.count) + ".csv";
}

/// Removes the partial files of the outputs that this run is about to write.
void remove_leftovers(const Batch& batch, const std::vector<Stimulus>& stimuli) {
    std::unordered_set<std::string> stems{fs::path(manifest_name(batch.shard)).stem()};
    // All parts write the table; one that is at it now must not lose its partial file.
    if (batch.shard.count == 1) stems.insert(fs::path(batch.rendition.encoding.transfer.name()).stem());
    for (const Stimulus& stimulus : stimuli) {
        stems.insert(fs::path(image_file_name(stimulus, batch.rendition.encoding.format)).stem());
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(batch.folder)) {
        const auto stem = partial_file_stem(entry.path().filename().string());
        std::error_code ignored;
        if (stem && stems.contains(*stem)) fs::remove(entry.path(), ignored);
    }
}

}  // namespace

BatchSummary write_batch(const std::vector<Stimulus>& stimuli, const Batch& batch, const LuminanceOf& luminance_of) {
    require_valid(batch.rendition);
    require_distinct_names(stimuli);
    const std::vector<Stimulus> part = batch.shard.of(stimuli);
    make_output_folder(batch.folder);
    if (batch.resume) remove_leftovers(batch, part);
    write_transfer_table(batch.folder, batch.rendition.encoding.transfer);

    std::atomic<size_t> kept = 0;
    {
        Progress progress("writing stimuli", static_cast<long>(part.size()));
        run_in_parallel(part.size(), batch.jobs, [&](size_t i) {
            const ImageEncoding& encoding = batch.rendition.encoding;
            const fs::path path = batch.folder / image_file_name(part[i], encoding.format);
            const std::string text = description(part[i], batch.rendition);
            if (batch.resume && stored_description(path) == text) {
                ++kept;
            } else {
                // The luminances go before the file's bytes come.
                const bool exact = batch.rendition.source == "exact";
                const StoredImage image =
                    exact ? encode_exact(part[i], encoding) : encode(part[i], luminance_of(part[i]), encoding);
                write_stored_image(path, image, text);
            }
            progress.advance();
        });
    }
    const std::string manifest = manifest_name(batch.shard);
    write_manifest(batch.folder / manifest, part, batch.rendition);
    return {part.size() - kept, kept, manifest};
}

}  // namespace stairstep
