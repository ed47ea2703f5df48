#include "stimuli/io/manifest.h"
#include "stimuli/io/csv.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "tests/fuzz/target.h"

namespace stairstep::fuzz {
namespace {

/// The manifest's row that says what this entry says.
std::string row_of(const ManifestEntry& entry) {
    std::vector<std::string> names{"file"};
    std::vector<std::string> values{entry.file};
    const std::string described = description(entry.stimulus, entry.rendition);
    size_t begin = 0;
    while (begin < described.size()) {
        const size_t end = std::min(described.find(';', begin), described.size());
        const size_t equals = described.find('=', begin);
        names.push_back(described.substr(begin, equals - begin));
        values.push_back(described.substr(equals + 1, end - equals - 1));
        begin = end + 1;
    }
    CsvWriter csv;
    csv.row(names);
    csv.row(values);
    return csv.text();
}

}  // namespace

void run_manifest(std::string_view input) {
    static const TemporaryFolder folder;
    bool is_table = false;
    std::optional<CsvTable> table;
    is_table = accepted([&] { table = CsvTable::parse(std::string(input), "stimuli.csv"); });
    if (!is_table) return;
    for (size_t row = 0; row < table->row_count(); ++row) {
        ManifestEntry entry;
        if (!accepted([&] { entry = manifest_entry(*table, row, folder.path()); })) continue;
        require(entry.file == image_file_name(entry.stimulus, entry.rendition.encoding.format),
                "an entry's file is its stimulus's");
        // Who made a line's picture is not kept: lines are exact. What tells fields apart in a description can't be in one.
        if (entry.rendition.source.find_first_of(";=") != std::string::npos) continue;
        const std::string written = row_of(entry);
        const ManifestEntry again = manifest_entry(CsvTable::parse(written, "again"), 0, folder.path());
        require(row_of(again) == written, "an entry reads back as it was written");
    }
}

}  // namespace stairstep::fuzz
