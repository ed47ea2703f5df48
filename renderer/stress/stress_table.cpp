#include "renderer/stress/stress_table.h"

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
    for (const ConditionResult& result : results) {
        text += "| " + result.condition.what + ": " + result.condition.value + " |";
        for (const Measurement& one : result.measurements) text += " " + cell(result.condition, one) + " |";
        text += "\n";
    }
    return text;
}

}  // namespace stairstep::stress
