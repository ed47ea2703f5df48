#include "stimuli/io/transfer_file.h"

#include "stimuli/error.h"
#include "stimuli/io/csv.h"
#include "stimuli/io/output_file.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

Transfer read_table(const std::filesystem::path& path) {
    const CsvTable table = CsvTable::read(path);
    const size_t level = table.column("level");
    const size_t luminance = table.column("luminance");
    const size_t rows = table.row_count();
    if (rows < 2)
        throw InputError(path.string(), "has fewer than two measurements", "measure at least black and white");

    std::vector<Transfer::Point> points;
    for (size_t row = 0; row < rows; ++row) {
        points.push_back({table.number(row, level), table.number(row, luminance)});
        if (points.back().luminance < 0) table.reject(row, luminance, "is negative", "luminances are 0 or above");
        if (row == 0) continue;
        const Transfer::Point& before = points[row - 1];
        const char* remedy = "both columns must strictly increase; smooth or leave out that measurement";
        if (points[row].level <= before.level) table.reject(row, level, "doesn't increase", remedy);
        if (points[row].luminance <= before.luminance) table.reject(row, luminance, "doesn't increase", remedy);
    }
    const Transfer::Point last = points.back();
    if (points.front().level != 0) table.reject(0, level, "isn't 0", "start with the darkest level, 0");
    if (last.level != 1 && last.level != 255) {
        table.reject(rows - 1, level, "is neither 1 nor 255", "end with the brightest level, 1 or 255");
    }
    for (size_t row = 0; row < rows; ++row) {
        points[row].level /= last.level;
        points[row].luminance /= last.luminance;
        // Measurements closer than a double tells apart are the same.
        if (row > 0 && points[row].level <= points[row - 1].level) {
            table.reject(row, level, "doesn't increase", "leave out that measurement");
        }
        if (row > 0 && points[row].luminance <= points[row - 1].luminance) {
            table.reject(row, luminance, "doesn't increase", "leave out that measurement");
        }
    }
    return Transfer::table(std::move(points));
}

}  // namespace

Transfer read_transfer(const std::string& name_or_file, const std::filesystem::path& folder) {
    if (const auto transfer = Transfer::named(name_or_file)) return *transfer;
    const std::filesystem::path path = folder / name_or_file;
    std::error_code error;
    if (name_or_file.empty() || !std::filesystem::exists(path, error)) {
        throw InputError("transfer " + name_or_file, "is neither a transfer nor a file",
                         "use linear, srgb, gamma=2.2 or a table with the columns level,luminance");
    }
    return read_table(path);
}

void write_transfer_table(const std::filesystem::path& folder, const Transfer& transfer) {
    if (transfer.points().empty()) return;
    CsvWriter csv;
    csv.row({"level", "luminance"});
    for (const Transfer::Point& point : transfer.points()) {
        csv.row({format_number(point.level), format_number(point.luminance)});
    }
    write_file(folder / transfer.name(), csv.text());
}

}  // namespace stairstep
