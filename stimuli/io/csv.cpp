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

/// Readers, this one too, trim spaces around a field that isn't quoted.
bool needs_quotes(const std::string& field) {
    const auto is_space = [](char c) { return c == ' ' || c == '\t'; };
    return field.find_first_of(",\"\r\n") != std::string::npos ||
           (!field.empty() && (is_space(field.front()) || is_space(field.back())));
}

constexpr size_t kBlockSize = 1 << 16;
constexpr size_t kLongestLine = 1 << 20;

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

struct CsvStream::Parser {
    Parser() {
        if (csv_init(&state, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
    }
    ~Parser() { csv_free(&state); }
    Parser(const Parser&) = delete;
    Parser& operator=(const Parser&) = delete;

    /// Called by libcsv, which is no C++: nothing here throws but for want of memory, and that ends the program.
    static void end_field(void* field, size_t size, void* self) noexcept {
        auto& parser = *static_cast<Parser*>(self);
        parser.text.append(static_cast<const char*>(field), size);
        parser.ends.push_back(parser.text.size());
    }
    static void end_row(int, void* self) noexcept { static_cast<Parser*>(self)->complete = true; }

    csv_parser state;
    /// The fields one after the other, and where each ends.
    std::string text;
    std::vector<size_t> ends;
    bool complete = false;
};

CsvStream::CsvStream(std::FILE* file, std::string source)
    : file_(file), source_(std::move(source)), parser_(std::make_unique<Parser>()) {
    if (!read_row()) throw InputError(source_, "is empty", "a header line and rows are needed");
    for (size_t i = 0; i < parser_->ends.size(); ++i) header_.emplace_back(text(i));
    const std::set<std::string> names(header_.begin(), header_.end());
    if (names.size() != header_.size()) reject_line("names a column twice");
}

CsvStream::~CsvStream() = default;

size_t CsvStream::column(const std::string& name) const {
    const auto found = std::find(header_.begin(), header_.end(), name);
    if (found == header_.end()) {
        throw InputError(source_, "has no column \"" + name + "\"", "add it or export the table again");
    }
    return static_cast<size_t>(found - header_.begin());
}

bool CsvStream::next() {
    if (!read_row()) return false;
    if (parser_->ends.size() != header_.size()) {
        reject_line("has " + std::to_string(parser_->ends.size()) + " fields where the header has " +
                    std::to_string(header_.size()));
    }
    return true;
}

std::string_view CsvStream::text(size_t column) const {
    const size_t begin = column == 0 ? 0 : parser_->ends[column - 1];
    return std::string_view(parser_->text).substr(begin, parser_->ends[column] - begin);
}

double CsvStream::number(size_t column) const {
    const auto value = parse_number(text(column));
    if (!value) {
        reject(column, "\"" + std::string(text(column).substr(0, 40)) + "\" is no finite number",
               "write for example 12.5");
    }
    return *value;
}

void CsvStream::reject(size_t column, const std::string& problem, const std::string& remedy) const {
    throw InputError(source_, "line " + std::to_string(row_line_) + ", column " + header_[column] + ": " + problem,
                     remedy);
}

void CsvStream::reject_line(const std::string& problem) const {
    throw InputError(source_, "line " + std::to_string(row_line_) + " " + problem, "mend that line or export it again");
}

bool CsvStream::read_row() {
    Parser& parser = *parser_;
    parser.text.clear();
    parser.ends.clear();
    parser.complete = false;
    size_t row_size = 0;
    while (!parser.complete) {
        if (!read_line()) {
            if (csv_fini(&parser.state, Parser::end_field, Parser::end_row, &parser) != 0) {
                reject_line("has a stray or unclosed quote");
            }
            return parser.complete;
        }
        if (row_size == 0) row_line_ = line_number_;
        const bool is_blank = line_.size() == 1 && (line_[0] == '\n' || line_[0] == '\r');
        if (!(is_blank && row_size == 0)) row_size += line_.size();
        if (row_size > kLongestLine) reject_line("is longer than 1 MiB");
        if (csv_parse(&parser.state, line_.data(), line_.size(), Parser::end_field, Parser::end_row, &parser) !=
            line_.size()) {
            reject_line("has a stray or unclosed quote");
        }
    }
    return true;
}

/// The next line with the "\n" or "\r" that ends it; a "\n" after a "\r" comes by itself and doesn't count as a line.
bool CsvStream::read_line() {
    line_.clear();
    for (;;) {
        if (block_at_ == block_.size()) {
            block_.resize(kBlockSize);
            block_.resize(std::fread(block_.data(), 1, kBlockSize, file_));
            block_at_ = 0;
            if (block_.empty()) {
                if (std::ferror(file_) != 0) throw FailureError(source_, "can't be read", "check where it comes from");
                if (!line_.empty()) ++line_number_;
                return !line_.empty();
            }
            if (block_.find('\0') != std::string::npos) {
                throw InputError(source_, "is no text: it holds NUL bytes", "name a CSV file");
            }
            // A byte-order mark is not part of the first name.
            if (bytes_ == 0 && block_.starts_with("\xEF\xBB\xBF")) block_at_ = 3;
            bytes_ += static_cast<long>(block_.size());
            continue;
        }
        if (after_carriage_return_ && block_[block_at_] == '\n') {
            after_carriage_return_ = false;
            ++block_at_;
            line_ = "\n";
            return true;
        }
        after_carriage_return_ = false;
        const char* begin = block_.data() + block_at_;
        const char* end = block_.data() + block_.size();
        const char* stop = std::find_if(begin, end, [](char c) { return c == '\n' || c == '\r'; });
        if (stop != end) ++stop;
        line_.append(begin, stop);
        block_at_ = static_cast<size_t>(stop - block_.data());
        if (line_.back() == '\n' || line_.back() == '\r') {
            after_carriage_return_ = line_.back() == '\r';
            ++line_number_;
            return true;
        }
        if (line_.size() > kLongestLine) {
            row_line_ = line_number_ + 1;
            reject_line("is longer than 1 MiB");
        }
    }
}

void CsvWriter::row(const std::vector<std::string>& fields) {
    for (size_t i = 0; i < fields.size(); ++i) {
        if (i > 0) text_ += ',';
        if (!needs_quotes(fields[i])) {
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
