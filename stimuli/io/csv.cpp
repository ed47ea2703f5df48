#include "stimuli/io/csv.h"

#include <csv.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <set>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

struct Rows {
    std::vector<std::vector<std::string>> complete;
    std::vector<std::string> current;
};

void end_field(void* field, size_t size, void* rows) {
    auto& current = static_cast<Rows*>(rows)->current;
    current.emplace_back(static_cast<const char*>(field), size);
}

void end_row(int, void* data) {
    auto& rows = *static_cast<Rows*>(data);
    rows.complete.push_back(std::move(rows.current));
    rows.current.clear();
}

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& path) {
    return parse(read_file(path), path.string());
}

CsvTable CsvTable::parse(const std::string& text, const std::string& source) {
    const auto reject_line = [&source](size_t line, const std::string& problem) {
        throw InputError(source, "line " + std::to_string(line) + " " + problem, "mend that line or export it again");
    };
    if (text.find('\0') != std::string::npos) {
        throw InputError(source, "is no text: it holds NUL bytes", "name a CSV file");
    }

    csv_parser parser;
    if (csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
    const std::unique_ptr<csv_parser, void (*)(csv_parser*)> owner(&parser, csv_free);
    // A byte-order mark is not part of the first name.
    const size_t skip = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    Rows rows;
    const size_t parsed = csv_parse(&parser, text.data() + skip, text.size() - skip, end_field, end_row, &rows);
    if (parsed != text.size() - skip || csv_fini(&parser, end_field, end_row, &rows) != 0) {
        reject_line(rows.complete.size() + 1, "has a stray or unclosed quote");
    }

    CsvTable table;
    table.source_ = source;
    if (rows.complete.empty()) throw InputError(source, "is empty", "a header line and rows are needed");
    table.header_ = std::move(rows.complete.front());
    const std::set<std::string> names(table.header_.begin(), table.header_.end());
    if (names.size() != table.header_.size()) reject_line(1, "names a column twice");
    rows.complete.erase(rows.complete.begin());
    table.rows_ = std::move(rows.complete);
    for (size_t row = 0; row < table.rows_.size(); ++row) {
        if (table.rows_[row].size() != table.header_.size()) {
            reject_line(row + 2, "has " + std::to_string(table.rows_[row].size()) + " fields where the header has " +
                                     std::to_string(table.header_.size()));
        }
    }
    return table;
}

size_t CsvTable::column(const std::string& name) const {
    if (const auto found = find_column(name)) return *found;
    throw InputError(source_, "has no column \"" + name + "\"", "add it or export the table again");
}

std::optional<size_t> CsvTable::find_column(const std::string& name) const {
    const auto found = std::find(header_.begin(), header_.end(), name);
    if (found == header_.end()) return std::nullopt;
    return static_cast<size_t>(found - header_.begin());
}

double CsvTable::number(size_t row, size_t column) const {
    const auto value = parse_number(text(row, column));
    if (!value) reject(row, column, "\"" + text(row, column) + "\" is no finite number", "write for example 12.5");
    return *value;
}

void CsvTable::reject(size_t row, size_t column, const std::string& problem, const std::string& remedy) const {
    throw InputError(source_, "line " + std::to_string(row + 2) + ", column " + header_[column] + ": " + problem,
                     remedy);
}

void CsvWriter::row(const std::vector<std::string>& fields) {
    for (size_t i = 0; i < fields.size(); ++i) {
        if (i > 0) text_ += ',';
        if (fields[i].find_first_of(",\"\r\n") == std::string::npos) {
            text_ += fields[i];
            continue;
        }
        text_ += '"';
        for (const char c : fields[i]) {
            if (c == '"') text_ += '"';
            text_ += c;
        }
        text_ += '"';
    }
    text_ += '\n';
}

}  // namespace stairstep
