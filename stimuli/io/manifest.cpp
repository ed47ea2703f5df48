#include "stimuli/io/manifest.h"

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/transfer_file.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// A manifest row but for the file's name.
std::vector<Field> fields_of(const Stimulus& stimulus, const Rendition& rendition) {
    const ImageEncoding& encoding = rendition.encoding;
    const auto& geometry = rendition.pixels_per_degree;
    std::vector<Field> fields = fields_of(stimulus);
    // A line has no shadow map: whatever draws the artifacts, lines are exact.
    fields.emplace_back("source", stimulus.pattern == Pattern::line ? "exact" : rendition.source);
    fields.emplace_back("transfer", encoding.transfer.name());
    fields.emplace_back("bits", std::to_string(encoding.bits));
    fields.emplace_back("dither", std::string(name(encoding.dither)));
    fields.emplace_back("pixels_per_degree", geometry ? format_number(*geometry) : "");
    return fields;
}

ImageFormat format_of(const std::string& file, const std::string& place) {
    const size_t dot = file.rfind('.');
    if (const auto format = image_format_named(dot == std::string::npos ? "" : file.substr(dot + 1))) return *format;
    throw InputError(place, "\"" + file + "\" is no stimulus's file", "write the manifest again");
}

}  // namespace

void require_valid(const Rendition& rendition) {
    require_valid(rendition.encoding);
    // The upper bound is far beyond what the eye resolves; it catches a slip of units.
    const auto& geometry = rendition.pixels_per_degree;
    if (geometry && !(*geometry > 0 && *geometry <= 1e6)) {
        throw InputError("--pixels-per-degree", format_number(*geometry) + " is out of range",
                         "give a number above 0 and up to 10^6, for example 60");
    }
}

std::string image_file_name(const Stimulus& stimulus, ImageFormat format) {
    return file_stem(stimulus) + "." + std::string(name(format));
}

std::string description(const Stimulus& stimulus, const Rendition& rendition) {
    std::string text;
    for (const auto& [name, value] : fields_of(stimulus, rendition)) {
        text += (text.empty() ? "" : ";") + name + "=" + value;
    }
    return text;
}

void write_manifest(const std::filesystem::path& path, std::span<const Stimulus> stimuli, const Rendition& rendition) {
    CsvWriter csv;
    std::vector<std::string> names{"file"};
    for (const auto& [name, value] : fields_of({}, rendition)) names.push_back(name);
    csv.row(names);
    for (const Stimulus& stimulus : stimuli) {
        std::vector<std::string> row{image_file_name(stimulus, rendition.encoding.format)};
        for (const auto& [name, value] : fields_of(stimulus, rendition)) row.push_back(value);
        csv.row(row);
    }
    write_file(path, csv.text());
}

ManifestEntry manifest_entry(const CsvTable& manifest, size_t row, const std::filesystem::path& folder) {
    const auto text = [&](const char* column) { return manifest.text(row, manifest.column(column)); };
    const auto column_if_filled = [&](const char* name) {
        const auto column = manifest.find_column(name);
        return column && !manifest.text(row, *column).empty() ? column : std::nullopt;
    };
    ManifestEntry entry{text("file"), stimulus_at(manifest, row), {}};
    Rendition& rendition = entry.rendition;
    ImageEncoding& encoding = rendition.encoding;
    encoding.format = format_of(entry.file, manifest.place(row));
    rendition.source = text("source");

    const double bits = manifest.number(row, manifest.column("bits"));
    encoding.bits = bits == 8 || bits == 16 || bits == 32 ? static_cast<int>(bits) : 0;
    if (const auto column = column_if_filled("dither")) {
        const auto dither = dither_named(manifest.text(row, *column));
        if (!dither) manifest.reject(row, *column, "is no dither", "write none, ordered or error-diffusion");
        encoding.dither = *dither;
    }
    if (const auto column = column_if_filled("pixels_per_degree")) {
        rendition.pixels_per_degree = manifest.number(row, *column);
    }
    // A manifest may come from anywhere, and must not have files read that lie elsewhere, or never end.
    if (text("transfer").find('/') != std::string::npos) {
        throw InputError(manifest.place(row), "the transfer " + text("transfer") + " is not beside it",
                         "write the manifest again");
    }
    try {
        encoding.transfer = read_transfer(text("transfer"), folder);
        require_valid(rendition);
    } catch (const InputError& error) {
        throw InputError(manifest.place(row), error.what(), "write the manifest again");
    }
    if (encoding.transfer.name() != text("transfer")) {
        throw InputError(manifest.place(row), "the table " + text("transfer") + " is not the one that was used",
                         "restore it, or write the stimuli again");
    }
    // A name that is the stimulus's own also leads nowhere outside the folder.
    const std::string file = image_file_name(entry.stimulus, encoding.format);
    if (entry.file != file) {
        throw InputError(manifest.place(row), "names the file \"" + entry.file + "\" where its stimulus's is " + file,
                         "write the manifest again");
    }
    return entry;
}

}  // namespace stairstep
