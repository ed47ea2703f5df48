#include "renderer/stress/stress_table.h"

#include <algorithm>

#include "stimuli/number.h"

namespace stairstep::stress {
namespace {

/// Texels below which a gap at a contact isn't told.
constexpr double kLeastDetachment = 0.1;

std::string cell(const Condition& condition, const Measurement& one) {
    const std::string outcome = outcome_of(one);
    std::string text = outcome != "drawn"                    ? outcome
                       : condition.course == Course::picture ? format_fixed(one.error_rmse, 4)
                       : one.drift                           ? "drift " + format_fixed(*one.drift, 4)
                                                             : "–";
    if (one.acne_share.value_or(0) > 0) text += ", acne " + format_fixed(100 * *one.acne_share, 2) + " %";
    if (one.detachment_texels.value_or(0) >= kLeastDetachment) {
        text += ", gap " + format_fixed(*one.detachment_texels, 2);
    }
    if (one.growth_kib) text += ", " + format_fixed(*one.growth_kib, 0) + " KiB";
    if (one.late_growth_kib) text += " (" + format_fixed(*one.late_growth_kib, 0) + ")";
    if (one.nan_pixels > 0) text += ", NaN " + std::to_string(one.nan_pixels);
    if (one.gl_errors > 0) text += ", GL errors " + std::to_string(one.gl_errors);
    return text;
}

/// A row of the table: values of one kind of condition that have the same cells.
struct Row {
    std::string values;
    std::string cells;
};

}  // namespace

std::string stress_table(const std::vector<ConditionResult>& results) {
    if (results.empty()) return "";
    std::string text = "| condition |";
    std::string rule = "|---|";
    for (const Measurement& one : results.front().measurements) {
        text += " " + one.technique + " |";
        rule += "---|";
    }
    text += "\n" + rule + "\n";

    std::vector<std::pair<std::string, std::vector<Row>>> kinds;
    for (const auto& [condition, measurements] : results) {
        auto kind = std::ranges::find(kinds, condition.what, &std::pair<std::string, std::vector<Row>>::first);
        if (kind == kinds.end()) kind = kinds.insert(kinds.end(), {condition.what, {}});
        std::string cells;
        for (const Measurement& one : measurements) cells += " " + cell(condition, one) + " |";
        const auto same = std::ranges::find(kind->second, cells, &Row::cells);
        if (same != kind->second.end()) {
            same->values += "; " + condition.value;
        } else {
            kind->second.push_back({condition.value, cells});
        }
    }
    for (const auto& [what, rows] : kinds) {
        for (const Row& row : rows) text += "| " + what + ": " + row.values + " |" + row.cells + "\n";
    }
    return text;
}

}  // namespace stairstep::stress
