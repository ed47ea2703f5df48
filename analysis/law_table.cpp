#include "analysis/law_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "stimuli/number.h"

namespace stairstep {
namespace {

using Row = std::vector<std::string>;

/// Characters as a terminal counts them: UTF-8's continuation bytes take no column.
size_t columns_of(const std::string& text) {
    return static_cast<size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string in_brackets(const Interval& interval, int decimals = 2) {
    return "[" + format_fixed(interval.first, decimals) + ", " + format_fixed(interval.second, decimals) + "]";
}

std::string percent(double share) {
    return (share >= 0 ? "+" : "") + format_fixed(100 * share, 1) + " %";
}

/// "sim03 (+2.1 %)", the one whose absence moves the slope furthest.
std::string largest_of(const std::vector<LeftOut>& table, const std::string& unit) {
    for (const LeftOut& l : table) {
        if (l.is_largest) return l.left_out + unit + " (" + percent(l.change) + ")";
    }
    return "–";
}

bool has_kernels(const Law& law) {
    return std::any_of(law.conditions.begin(), law.conditions.end(),
                       [&](const ConditionLaw& c) { return c.kernel != law.kernel; });
}

std::string condition_rows(const Law& law) {
    std::vector<Row> rows{{"condition", "c", "95 %", "tau", "intercept, px", "exponent", "most hangs on", "and on size",
                           "observers", "trials"}};
    for (const ConditionLaw& c : law.conditions) {
        rows.push_back({describe({c.pattern, c.contrast, c.kernel}, has_kernels(law)), format_fixed(c.slope, 3),
                        in_brackets(c.slope_ci95), format_fixed(c.tau_ln, 2),
                        c.has_form ? format_fixed(c.intercept_px, 2) + " " + in_brackets(c.intercept_ci95) : "–",
                        c.has_form ? format_fixed(c.exponent, 2) + " " + in_brackets(c.exponent_ci95) : "–",
                        largest_of(c.without_observer, ""), largest_of(c.without_size, " px"),
                        std::to_string(c.observers), std::to_string(c.trials)});
    }
    return aligned_rows(rows) + "  each c: " + law.conditions.front().slope_method + "\n";
}

std::string comparison_rows(const Law& law) {
    std::vector<Row> rows{{"compared, paired", "ratio", "95 %", "p", "p (Holm)", "observers"}};
    for (const Comparison& c : law.comparisons) {
        rows.push_back({describe(c.first, has_kernels(law)) + " / " + describe(c.second, has_kernels(law)),
                        format_fixed(c.ratio, 3), in_brackets(c.ratio_ci95), p_text(c.p), p_text(c.p_holm),
                        std::to_string(c.observers)});
    }
    return aligned_rows(rows);
}

std::string criterion_rows(const Law& law) {
    std::vector<Row> rows{{"share right", "c", "95 %", "texels across / p = .82", "texels in all / p = .82"}};
    for (const CriterionLaw& c : law.criteria) {
        rows.push_back({format_number(c.threshold_probability), format_fixed(c.slope, 3), in_brackets(c.slope_ci95),
                        format_fixed(c.texels_across, 3), format_fixed(c.texels_in_all, 3)});
    }
    return aligned_rows(rows);
}

}  // namespace

std::string aligned_rows(const std::vector<Row>& rows) {
    std::vector<size_t> widths;
    for (const Row& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns_of(row[i]));
    }
    std::string text;
    for (const Row& row : rows) {
        std::string line = "  ";
        for (size_t i = 0; i < row.size(); ++i) line += row[i] + std::string(widths[i] - columns_of(row[i]) + 2, ' ');
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

std::string p_text(double p) {
    return p < 0.0001 ? "< 0.0001" : format_fixed(p, 4);
}

std::string law_table(const Law& law) {
    std::string text;
    if (!law.conditions.empty()) text += condition_rows(law);
    for (const ConditionLaw& c : law.conditions) {
        if (!c.has_form) {
            text +=
                "  " + describe({c.pattern, c.contrast, c.kernel}) + ": intercept and exponent " + c.form_method + "\n";
        }
    }
    if (!law.comparisons.empty()) text += comparison_rows(law);
    text += "law: r = " + format_fixed(law.slope, 3) + " a, 95 % interval " + in_brackets(law.slope_ci95) +
            " (worst case: " + describe({law.pattern, law.contrast, law.kernel}) + ")\n";
    if (!law.slope_method.empty()) text += "  " + law.slope_method + "\n";
    if (!law.criteria.empty()) text += criterion_rows(law);
    return text;
}

}  // namespace stairstep
