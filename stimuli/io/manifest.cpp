#include "stimuli/io/manifest.h"

#include "stimuli/io/csv.h"
#include "stimuli/io/output_file.h"
#include "stimuli/number.h"

namespace stairstep {

std::string image_file_name(const Stimulus& stimulus) {
    return file_stem(stimulus) + ".png";
}

void write_manifest(const std::filesystem::path& path, const std::vector<Stimulus>& stimuli,
                    const std::string& source) {
    CsvWriter csv;
    csv.row({"file", "pattern", "kernel", "contrast", "texel_px", "radius_px", "width_px", "height_px", "silhouette",
             "step_reference", "source", "transfer", "bits"});
    for (const Stimulus& s : stimuli) {
        csv.row({image_file_name(s), std::string(name(s.pattern)), std::string(name(s.kernel.shape)),
                 format_number(s.contrast), format_number(s.texel_px), format_number(s.kernel.radius_px),
                 std::to_string(s.width_px), std::to_string(s.height_px), std::string(name(s.silhouette)),
                 std::string(name(s.step_reference)), s.pattern == Pattern::line ? "exact" : source, "linear", "8"});
    }
    write_file(path, csv.text());
}

}  // namespace stairstep
