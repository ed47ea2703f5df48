#include "renderer/stress/stress_csv.h"

#include "stimuli/io/csv.h"
#include "stimuli/number.h"

namespace stairstep::stress {
namespace {

std::string number(const std::optional<double>& value) {
    return value ? format_number(*value) : "";
}

}  // namespace

std::string outcome_of(const Measurement& one) {
    return !one.failure.empty() ? "failed" : !one.refusal.empty() ? "refused" : "drawn";
}

std::string stress_csv(const std::vector<ConditionResult>& results, const Setting& setting) {
    CsvWriter csv;
    csv.row({"condition", "value",      "technique", "outcome",    "error_rmse",
             "error_max", "nan_pixels", "gl_errors", "acne_share", "detachment_texels",
             "map_width", "map_height", "drift",     "growth_kib", "late_growth_kib",
             "message",   "width",      "height",    "renderer",   "context"});
    for (const ConditionResult& result : results) {
        const bool compared = result.condition.course == Course::picture;
        for (const Measurement& one : result.measurements) {
            const bool drawn = outcome_of(one) == "drawn";
            csv.row({result.condition.what,
                     result.condition.value,
                     one.technique,
                     outcome_of(one),
                     drawn && compared ? format_number(one.error_rmse) : "",
                     drawn && compared ? format_number(one.error_max) : "",
                     std::to_string(one.nan_pixels),
                     std::to_string(one.gl_errors),
                     number(one.acne_share),
                     number(one.detachment_texels),
                     std::to_string(one.map_width),
                     std::to_string(one.map_height),
                     number(one.drift),
                     number(one.growth_kib),
                     number(one.late_growth_kib),
                     one.failure + one.refusal,
                     std::to_string(setting.width),
                     std::to_string(setting.height),
                     setting.renderer,
                     setting.context});
        }
    }
    return csv.text();
}

}  // namespace stairstep::stress
