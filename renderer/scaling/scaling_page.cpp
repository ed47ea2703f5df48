#include "renderer/scaling/scaling_page.h"

#include <algorithm>
#include <cassert>

#include "embedded/scaling_page.h"
#include "stimuli/io/html.h"
#include "stimuli/number.h"

namespace stairstep::scaling {
namespace {

/// Exponents of parts that never take this much of a frame say nothing: they are the clock's.
constexpr double kLeastShare = 0.01;

void replace(std::string& html, const std::string& place, const std::string& value) {
    const std::string mark = "{{" + place + "}}";
    const size_t at = html.find(mark);
    assert(at != std::string::npos);
    html.replace(at, mark.size(), value);
}

std::string map_of(const Point& point) {
    if (point.map_width == 0) return "";
    return std::to_string(point.map_width) + " × " + std::to_string(point.map_height);
}

/// What a part takes of a frame, where that is most.
double largest_share(const Curve& curve, const Part& part) {
    double share = 0;
    for (const Point& point : curve.points) {
        share = std::max(share, part.ms(point.times) / point.times.frame.cpu_ms);
    }
    return share;
}

std::string table(const AxisCurves& axis) {
    std::string html = "<table>\n<thead><tr><th>technique</th>";
    for (const Part& part : parts()) html += "<th>" + escaped(part.name) + "</th>";
    html += "<th>growth</th><th>ms, first</th><th>ms, last</th><th>map, first</th><th>map, last</th></tr></thead>\n";
    html += "<tbody>\n";
    for (const Curve& curve : axis.curves) {
        html += curve.configuration.side ? "<tr>" : "<tr class=\"law\">";
        const auto cell = [&](const std::string& text) { html += "<td>" + escaped(text) + "</td>"; };
        cell(label(curve.configuration));
        for (const Part& part : parts()) {
            const std::optional<PowerLaw> law = law_of(curve, part);
            cell(law && largest_share(curve, part) >= kLeastShare ? exponent_text(*law) : "");
        }
        const Point& first = curve.points.front();
        const Point& last = curve.points.back();
        cell("× " + format_fixed(growth_of(curve), 2));
        cell(format_fixed(first.times.frame.cpu_ms, 1));
        cell(format_fixed(last.times.frame.cpu_ms, 1));
        cell(map_of(first));
        cell(map_of(last));
        html += "</tr>\n";
    }
    return html + "</tbody></table>\n";
}

std::string section(const AxisCurves& axis) {
    return "<h2>" + escaped(axis.axis) + "</h2>\n<figure><img src=\"" + escaped(figure_file(axis.axis)) +
           "\" alt=\"Frame time against " + escaped(axis.quantity) + "\"></figure>\n<div class=\"wide\">" +
           table(axis) + "</div>\n";
}

}  // namespace

std::string scaling_page(const std::vector<AxisCurves>& axes, const Setting& setting, const std::string& scenario) {
    std::string html(embedded::scaling_page_html);
    replace(html, "setting", escaped(setting.renderer + " · " + setting.context));
    replace(html, "scenario", escaped(scenario));
    replace(html, "frames", std::to_string(setting.frames));
    std::string sections;
    for (const AxisCurves& axis : axes) sections += section(axis);
    replace(html, "axes", sections);
    return html;
}

std::string figure_file(const std::string& axis) {
    return axis + ".svg";
}

}  // namespace stairstep::scaling
