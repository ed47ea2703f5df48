// Comma-separated tables (RFC 4180), read by column name. Parsing is libcsv's in strict mode.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stairstep {

/// A whole table: a header of distinct names, then rows of as many fields.
class CsvTable {
  public:
    /// Throws InputError naming the file and line for anything malformed: no header, a name twice, a row with
    /// another number of fields, a stray or unclosed quote, a NUL byte.
    static CsvTable read(const std::filesystem::path& path);

    /// As `read`, from text; `source` stands for the file's name in errors.
    static CsvTable parse(const std::string& text, const std::string& source);

    size_t row_count() const { return rows_.size(); }
    const std::vector<std::string>& header() const { return header_; }

    /// Names the table and a row's line, for errors about the row as a whole: "grid.csv: line 3".
    std::string place(size_t row) const { return source_ + ": line " + std::to_string(row + 2); }

    /// Position of a column. Throws InputError naming the file and the column where it is missing.
    size_t column(const std::string& name) const;
    std::optional<size_t> find_column(const std::string& name) const;

    const std::string& text(size_t row, size_t column) const { return rows_[row][column]; }

    /// A field as a finite number. Throws InputError naming file, line and column otherwise.
    double number(size_t row, size_t column) const;

    /// An error about one field: names the file, the row's line and the column.
    [[noreturn]] void reject(size_t row, size_t column, const std::string& problem, const std::string& remedy) const;

  private:
    std::string source_;
    std::vector<std::string> header_;
    std::vector<std::vector<std::string>> rows_;
};

/// A table row by row, for more rows than memory should hold: one row at a time, lines of up to 1 MiB. What is
/// malformed is refused as by CsvTable; its lines are counted as a text editor counts them.
class CsvStream {
  public:
    /// Reads the header. `file` stays the caller's and has to outlive the stream.
    CsvStream(std::FILE* file, std::string source);
    ~CsvStream();

    /// Position of a column of the header. Throws InputError naming the source and the column where it is missing.
    size_t column(const std::string& name) const;

    /// Goes on to the next row; false after the last. Throws InputError naming source and line for what is malformed.
    bool next();

    /// A field of the row, valid until `next`.
    std::string_view text(size_t column) const;
    /// The field as a finite number. Throws InputError naming source, line and column otherwise.
    double number(size_t column) const;

    /// An error about one field of the row.
    [[noreturn]] void reject(size_t column, const std::string& problem, const std::string& remedy) const;

    /// Bytes read so far.
    long bytes() const { return bytes_; }

  private:
    /// libcsv's state, and the row that it is at.
    struct Parser;

    bool read_row();
    bool read_line();
    [[noreturn]] void reject_line(const std::string& problem) const;

    std::FILE* file_;
    std::string source_;
    std::vector<std::string> header_;
    std::unique_ptr<Parser> parser_;
    std::string line_;
    std::string block_;
    size_t block_at_ = 0;
    /// The line that was read last, and the one on which the row begins; from 1.
    long line_number_ = 0;
    long row_line_ = 0;
    bool after_carriage_return_ = false;
    long bytes_ = 0;
};

/// Writes a table row by row into text.
class CsvWriter {
  public:
    /// Appends one row; fields with a comma, quote, line break, or space at an end are quoted.
    void row(const std::vector<std::string>& fields);
    const std::string& text() const { return text_; }

  private:
    std::string text_;
};

}  // namespace stairstep
