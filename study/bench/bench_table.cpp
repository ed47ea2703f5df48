#include "study/bench/bench_table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "stimuli/number.h"

namespace stairstep {
namespace {

std::string met_text(const BenchBar& bar) {
    if (!bar.met) return "unknown";
    if (*bar.met) return "yes";
    return bar.missed_by_se ? "NO, by " + format_fixed(*bar.missed_by_se, 1) + " SE" : "NO";
}

bool has_bars(const BenchTable& table) {
    return std::any_of(table.rows.begin(), table.rows.end(), [](const BenchRow& row) { return row.bar.has_value(); });
}

std::vector<std::string> header(const BenchTable& table) {
    std::vector<std::string> names = table.columns;
    if (has_bars(table)) names.insert(names.end(), {"bar", "met"});
    return names;
}

std::vector<BenchCell> cells(const BenchTable& table, const BenchRow& row) {
    std::vector<BenchCell> all = row.cells;
    if (has_bars(table)) {
        all.emplace_back(row.bar ? row.bar->text : "");
        all.emplace_back(row.bar ? met_text(*row.bar) : "");
    }
    return all;
}

/// A column of numbers, nothings aside, is set to the right.
bool is_numeric(const BenchTable& table, size_t column) {
    return column < table.columns.size() && std::all_of(table.rows.begin(), table.rows.end(), [&](const BenchRow& row) {
               return row.cells[column].number || row.cells[column].text.empty();
           });
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

/// Words in lines of at most 120 characters where no word is longer, lines after the first indented.
std::string wrapped(const std::string& text, const std::string& first, const std::string& indent) {
    constexpr size_t kWidth = 120;
    std::string lines;
    std::string line = first;
    bool is_empty = true;
    for (const std::string& word : split(text, ' ')) {
        if (!is_empty && line.size() + 1 + word.size() > kWidth) {
            lines += line + "\n";
            line = indent;
            is_empty = true;
        }
        line += (is_empty ? "" : " ") + word;
        is_empty = false;
    }
    return lines + line + "\n";
}

BenchBar limit_bar(const char* relation, double value, double limit, int decimals, double se, bool met) {
    BenchBar bar{relation + format_fixed(limit, decimals), std::nullopt};
    if (std::isfinite(value)) bar.met = met;
    if (bar.met == false && se > 0) bar.missed_by_se = std::abs(value - limit) / se;
    return bar;
}

}  // namespace

BenchCell::BenchCell(double value, int decimals) {
    if (!std::isfinite(value)) return;
    text = format_fixed(value, decimals);
    number = value;
}

BenchBar at_most(double value, double limit, int decimals, double se) {
    return limit_bar("<= ", value, limit, decimals, se, value <= limit);
}

BenchBar at_least(double value, double limit, int decimals, double se) {
    return limit_bar(">= ", value, limit, decimals, se, value >= limit);
}

std::string to_text(const BenchTable& table) {
    const std::vector<std::string> names = header(table);
    std::vector<std::vector<std::string>> lines{names};
    for (const BenchRow& row : table.rows) {
        lines.emplace_back();
        for (const BenchCell& cell : cells(table, row)) lines.back().push_back(cell.text);
    }
    std::string text = table.title + "\n\n";
    for (const std::vector<std::string>& line : lines) {
        std::string padded;
        for (size_t c = 0; c < names.size(); ++c) {
            size_t width = 0;
            for (const std::vector<std::string>& other : lines) width = std::max(width, other[c].size());
            const std::string space(width - line[c].size(), ' ');
            padded += (c > 0 ? "  " : "") + (is_numeric(table, c) ? space + line[c] : line[c] + space);
        }
        text += padded.substr(0, padded.find_last_not_of(' ') + 1) + "\n";
    }
    text += "\n";
    for (const std::string& note : table.notes) text += wrapped(note, "", "");
    return text;
}

std::string to_markdown(const BenchTable& table) {
    const std::vector<std::string> names = header(table);
    std::string text = "## " + table.title + "\n\n|";
    for (const std::string& name : names) text += " " + name + " |";
    text += "\n|";
    for (size_t c = 0; c < names.size(); ++c) text += is_numeric(table, c) ? "---:|" : "---|";
    for (const BenchRow& row : table.rows) {
        text += "\n|";
        for (const BenchCell& cell : cells(table, row)) text += " " + cell.text + " |";
    }
    text += "\n";
    if (!table.notes.empty()) text += "\n";
    for (const std::string& note : table.notes) text += wrapped(note, "- ", "  ");
    return text;
}

std::string to_csv(const std::vector<BenchTable>& tables) {
    std::string text = "table,row,column,value\n";
    for (const BenchTable& table : tables) {
        const std::vector<std::string> names = header(table);
        for (size_t r = 0; r < table.rows.size(); ++r) {
            const std::vector<BenchCell> row = cells(table, table.rows[r]);
            for (size_t c = 0; c < names.size(); ++c) {
                if (row[c].text.empty()) continue;
                text += table.name + "," + std::to_string(r + 1) + "," + names[c] + "," +
                        (row[c].number ? format_number(*row[c].number) : csv_field(row[c].text)) + "\n";
            }
        }
    }
    return text;
}

nlohmann::ordered_json to_json(const std::vector<BenchTable>& tables) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const BenchTable& table : tables) {
        nlohmann::ordered_json rows = nlohmann::ordered_json::array();
        for (const BenchRow& row : table.rows) {
            nlohmann::ordered_json object;
            for (size_t c = 0; c < table.columns.size(); ++c) {
                const BenchCell& cell = row.cells[c];
                object[table.columns[c]] = cell.number         ? nlohmann::ordered_json(*cell.number)
                                           : cell.text.empty() ? nlohmann::ordered_json(nullptr)
                                                               : nlohmann::ordered_json(cell.text);
            }
            if (row.bar) {
                object["bar"] = row.bar->text;
                object["met"] = row.bar->met ? nlohmann::ordered_json(*row.bar->met) : nlohmann::ordered_json(nullptr);
                if (row.bar->missed_by_se) object["missed_by_se"] = *row.bar->missed_by_se;
            }
            rows.push_back(std::move(object));
        }
        json[table.name] = {{"title", table.title}, {"rows", std::move(rows)}, {"notes", table.notes}};
    }
    return json;
}

}  // namespace stairstep
