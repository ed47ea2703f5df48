// Tables of measured figures: as text for a terminal, Markdown for the docs, CSV and JSON for other programs.
//
// A row may have a bar, a figure that the program sets itself, and says whether it is met. Columns are named as in files:
// lower case, underscores, the unit last.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace stairstep {

/// A word, a number with the decimals that people are shown, or nothing.
struct BenchCell {
    BenchCell() = default;
    BenchCell(std::string word) : text(std::move(word)) {}
    BenchCell(const char* word) : text(word) {}
    /// `decimals` from 0 to 12; one that isn't finite is shown as nothing.
    BenchCell(double number, int decimals);
    BenchCell(int number) : BenchCell(number, 0) {}

    std::string text{};
    std::optional<double> number = std::nullopt;
};

/// What a row should reach.
struct BenchBar {
    /// Such as "<= 2".
    std::string text;
    /// Nothing where it could not be measured.
    std::optional<bool> met;
    /// By how many of the figure's standard errors it is missed, where it is and they are known.
    std::optional<double> missed_by_se = std::nullopt;
};

struct BenchRow {
    /// As many as the table has columns.
    std::vector<BenchCell> cells;
    std::optional<BenchBar> bar = std::nullopt;
};

struct BenchTable {
    /// One word, the table's name in files.
    std::string name;
    std::string title;
    std::vector<std::string> columns;
    std::vector<BenchRow> rows{};
    /// Sentences below the table: how it was measured, what it doesn't say.
    std::vector<std::string> notes{};
};

/// `value` at most, or at least, `limit`; the limit is shown with so many decimals. `se` is the value's standard error, 0
/// where there is none to speak of.
BenchBar at_most(double value, double limit, int decimals, double se = 0);
BenchBar at_least(double value, double limit, int decimals, double se = 0);

/// Aligned columns, numbers to the right; `bar` and `met` (yes; NO, and by how many SE; unknown) stand last if any row has a bar.
std::string to_text(const BenchTable& table);
/// A heading of the second level, the table, its notes as a list.
std::string to_markdown(const BenchTable& table);
/// One line for each cell: `table,row,column,value`, rows from 1; empty cells are left out. Numbers in full.
std::string to_csv(const std::vector<BenchTable>& tables);
/// An object a table: name → {title, rows, notes}, rows with a key a column, numbers as numbers, nothing as null.
nlohmann::ordered_json to_json(const std::vector<BenchTable>& tables);

}  // namespace stairstep
