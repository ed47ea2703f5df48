#include "renderer/stress/stress_page.h"

#include <cassert>

#include "embedded/stress_page.h"
#include "stimuli/io/html.h"
#include "stimuli/number.h"

namespace stairstep::stress {
namespace {

void replace(std::string& html, const std::string& place, const std::string& value) {
    const std::string mark = "{{" + place + "}}";
    const size_t at = html.find(mark);
    assert(at != std::string::npos);
    html.replace(at, mark.size(), value);
}

bool is_broken(const Measurement& one) {
    return one.nan_pixels > 0 || one.gl_errors > 0 || !one.failure.empty();
}

std::string fixed(const std::optional<double>& value, int decimals) {
    return value ? format_fixed(*value, decimals) : "–";
}

/// A cell, marked where its value is something to look at.
std::string cell(const std::string& text, bool marked = false) {
    return (marked ? "<td class=\"marked\">" : "<td>") + escaped(text) + "</td>";
}

std::string technique_cells(const Condition& condition, const Measurement& one) {
    const std::string outcome = outcome_of(one);
    std::string html = cell(one.technique);
    if (outcome != "drawn") {
        return html + "<td colspan=\"10\" class=\"" + outcome + "\">" + outcome + ": " +
               escaped(one.failure + one.refusal) + "</td>";
    }
    const bool picture = condition.course == Course::picture;
    html += cell(std::to_string(one.map_width) + " × " + std::to_string(one.map_height));
    html += cell(picture ? format_fixed(one.error_rmse, 4) : "–");
    html += cell(picture ? format_fixed(one.error_max, 3) : "–");
    html += cell(std::to_string(one.nan_pixels), one.nan_pixels > 0);
    html += cell(std::to_string(one.gl_errors), one.gl_errors > 0);
    html += cell(one.acne_share ? format_fixed(100 * *one.acne_share, 2) : "–", one.acne_share && *one.acne_share > 0);
    html += cell(fixed(one.detachment_texels, 2), one.detachment_texels && *one.detachment_texels >= 1);
    html += cell(fixed(one.drift, 4), one.drift && *one.drift > 0);
    html += cell(fixed(one.growth_kib, 0));
    return html + cell(fixed(one.late_growth_kib, 0));
}

}  // namespace

size_t broken_rows(const std::vector<ConditionResult>& results) {
    size_t count = 0;
    for (const ConditionResult& result : results) {
        for (const Measurement& one : result.measurements) count += is_broken(one) ? 1 : 0;
    }
    return count;
}

std::string stress_page(const std::vector<ConditionResult>& results, const Setting& setting) {
    std::string rows;
    for (const ConditionResult& result : results) {
        const Condition& condition = result.condition;
        for (size_t i = 0; i < result.measurements.size(); ++i) {
            rows += i == 0 ? "<tr class=\"first\">" : "<tr>";
            if (i == 0) {
                rows += "<th scope=\"rowgroup\" rowspan=\"" + std::to_string(result.measurements.size()) + "\">" +
                        escaped(condition.what) + "<br><span class=\"value\">" + escaped(condition.value) +
                        "</span></th>";
            }
            rows += technique_cells(condition, result.measurements[i]) + "</tr>\n";
        }
    }
    const size_t broken = broken_rows(results);
    std::string html(embedded::stress_page_html);
    replace(html, "setting",
            escaped(std::to_string(setting.width) + " × " + std::to_string(setting.height) + " pixels · " +
                    setting.renderer + " · " + setting.context));
    replace(html, "verdict",
            broken == 0 ? "No NaN, no error of OpenGL and no failure under any condition."
                        : std::to_string(broken) + " rows with NaN pixels, errors of OpenGL or failures.");
    replace(html, "rows", rows);
    return html;
}

}  // namespace stairstep::stress
