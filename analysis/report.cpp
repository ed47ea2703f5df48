#include "analysis/report.h"

#include <cassert>
#include <cmath>
#include <filesystem>

#include "analysis/figures.h"
#include "analysis/law/sizing.h"
#include "embedded/report.h"
#include "stimuli/error.h"
#include "stimuli/io/json_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string escaped(const std::string& text) {
    std::string html;
    for (const char c : text) {
        switch (c) {
            case '&': html += "&amp;"; break;
            case '<': html += "&lt;"; break;
            case '>': html += "&gt;"; break;
            case '"': html += "&quot;"; break;
            default: html += c;
        }
    }
    return html;
}

/// Replaces each {{name}}; a value without a place in the page is a bug.
class Page {
  public:
    explicit Page(std::string_view html) : html_(html) {}

    Page& set(const std::string& name, const std::string& html) {
        const std::string mark = "{{" + name + "}}";
        assert(html_.find(mark) != std::string::npos);
        for (size_t at = 0; (at = html_.find(mark, at)) != std::string::npos; at += html.size()) {
            html_.replace(at, mark.size(), html);
        }
        return *this;
    }
    Page& text(const std::string& name, const std::string& text) { return set(name, escaped(text)); }

    const std::string& html() const { return html_; }

  private:
    std::string html_;
};

std::string base64(const std::string& bytes) {
    constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](size_t k) {
            return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
        };
        const unsigned group = byte(0) << 16 | byte(1) << 8 | byte(2);
        text += kAlphabet[group >> 18];
        text += kAlphabet[group >> 12 & 63];
        text += i + 1 < bytes.size() ? kAlphabet[group >> 6 & 63] : '=';
        text += i + 2 < bytes.size() ? kAlphabet[group & 63] : '=';
    }
    return text;
}

std::string embedded_png(const fs::path& path, const std::string& description) {
    const std::string bytes = read_file(path);
    if (!bytes.starts_with("\x89PNG")) throw InputError(path.string(), "is no PNG", "name a PNG");
    return "<img alt=\"" + escaped(description) + "\" src=\"data:image/png;base64," + base64(bytes) + "\">";
}

/// gnuplot's XML header has no place inside a page.
std::string inline_svg(const std::string& svg) {
    return svg.substr(svg.find("<svg"));
}

std::string in_brackets(const Interval& interval, int decimals) {
    return "[" + format_fixed(interval.first, decimals) + ", " + format_fixed(interval.second, decimals) + "]";
}

std::string describe(Pattern pattern, double contrast) {
    return std::string(name(pattern)) + " at " + format_number(100 * contrast) + " % contrast";
}

std::string law_rows(const Law& law) {
    std::string rows;
    for (const ConditionLaw& c : law.conditions) {
        rows += "<tr><td>" + describe(c.pattern, c.contrast) + "</td><td>" + format_fixed(c.slope, 2) + "</td><td>" +
                format_fixed(c.slope_ci95.first, 2) + " to " + format_fixed(c.slope_ci95.second, 2) + "</td><td>" +
                format_fixed(c.tau_ln, 2) + "</td><td>" +
                (c.has_form ? format_fixed(c.intercept_px, 1) + " " + in_brackets(c.intercept_ci95, 1) : "–") +
                "</td><td>" + (c.has_form ? format_fixed(c.exponent, 2) + " " + in_brackets(c.exponent_ci95, 2) : "–") +
                "</td><td>" + std::to_string(c.observers) + "</td><td>" + std::to_string(c.trials) + "</td></tr>\n";
    }
    return rows;
}

std::string comparisons_table(const Law& law) {
    if (law.comparisons.empty()) return "";
    std::string rows;
    for (const Comparison& c : law.comparisons) {
        rows += "<tr><td>" + describe(c.first.pattern, c.first.contrast) + " / " +
                describe(c.second.pattern, c.second.contrast) + "</td><td>" + format_fixed(c.ratio, 2) + "</td><td>" +
                format_fixed(c.ratio_ci95.first, 2) + " to " + format_fixed(c.ratio_ci95.second, 2) + "</td><td>" +
                (c.p_holm < 0.0001 ? "&lt; 0.0001" : format_fixed(c.p_holm, 4)) + "</td><td>" +
                std::to_string(c.observers) + "</td></tr>\n";
    }
    return "<table>\n<tr><th>slopes compared, observer by observer</th><th>ratio</th><th>95 % interval</th>"
           "<th>p (paired t, Holm)</th><th>observers</th></tr>\n" +
           rows + "</table>\n";
}

/// N = ⌈c·L/r⌉ at several criteria and radii: what a stricter criterion costs.
std::string budget_section(const Law& law) {
    if (law.criteria.empty()) return "";
    constexpr double kShares[] = {0.005, 0.01, 0.02, 0.05};
    std::string head = "<tr><th>hidden means</th><th>c</th><th>95 % interval</th>";
    for (const double share : kShares) head += "<th>r = " + format_number(100 * share) + " % of L</th>";
    std::string rows;
    for (const CriterionLaw& c : law.criteria) {
        rows += "<tr><td>" + format_number(std::round(1000 * c.threshold_probability) / 10) + " % right</td><td>" +
                format_fixed(c.slope, 2) + "</td><td>" + format_fixed(c.slope_ci95.first, 2) + " to " +
                format_fixed(c.slope_ci95.second, 2) + "</td>";
        for (const double share : kShares) {
            const MapSize size = shadow_map_size({.slope = c.slope, .radius = share, .extent = 1});
            rows += "<td>" + std::to_string(size.texels) + "</td>";
        }
        rows += "</tr>\n";
    }
    return "<h2>Texels for a filter radius</h2>\n<table>\n" + head + "</tr>\n" + rows +
           "</table>\n<p>Texels along one side of a shadow map that spans L, under a filter of radius r, for "
           "thresholds at "
           "several shares of right answers. The smaller the share, the less is seen, and the more radius, or the more "
           "texels, that takes. Each is the worst case of the conditions.</p>\n";
}

std::string warnings_list(const std::vector<std::string>& warnings) {
    if (warnings.empty()) return "";
    std::string items;
    for (const std::string& warning : warnings) items += "<li>" + escaped(warning) + "</li>\n";
    return "<p>To know about this fit:</p>\n<ul>\n" + items + "</ul>\n";
}

std::string contact_sheet_section(const std::string& path) {
    return "<h2>What the observers judge</h2>\n<figure>" +
           embedded_png(path, "contact sheet of filtered shadow edges") +
           "<figcaption>Filtered shadow edges, at half size. Down a column the texel grows and the steps come back; "
           "along "
           "a row the filter grows and they vanish. They vanish where the radius is the same number of texels, "
           "whatever the "
           "texel's size.</figcaption></figure>\n";
}

constexpr std::string_view kRenderingsSection = R"html(<h2>What the law saves</h2>
<p>{{scene}} with {{technique}} shadows of one filter radius, {{radius}} px on screen, at each size of shadow map. Times are
medians of one run, in which the sizes took turns frame by frame, on {{gl}}.</p>
<div class="pair">
{{pictures}}</div>
<table>
<tr><th>map</th><th>texels</th><th>texel on screen, px</th><th>filter</th><th>frame, ms</th><th>depth pass, ms</th><th>lighting, ms</th><th>error</th></tr>
{{rows}}</table>
<p>Error: root mean square of visibility (0 to 1) in the penumbra, against the same filter converged on an 8192 × 8192 map.
A sampled filter takes a few taps a pixel and adds noise; an exact one weighs every texel it covers.</p>
{{difference}})html";

/// A number of stats.json for people; a dash where it isn't there.
std::string number_or_dash(const json& object, const std::string& key, int decimals) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? format_fixed(found->get<double>(), decimals) : "–";
}

std::string renderings_section(const fs::path& stats_path) {
    const std::string source = stats_path.string();
    const json stats = read_json(stats_path);
    const auto renderings = stats.find("renderings");
    if (renderings == stats.end() || !renderings->is_array() || renderings->empty()) {
        throw InputError(source, "lists no \"renderings\"", "write it with stairstep-render image");
    }
    std::string pictures;
    std::string rows;
    for (const json& r : *renderings) {
        if (!r.is_object()) throw InputError(source, "\"renderings\" holds something else", "write it again");
        const std::string size = number_or_dash(r, "width", 0) + " × " + number_or_dash(r, "height", 0);
        const std::string title = json_text(r, "resolution", source) + ": " + size + " texels";
        pictures += "<figure>" + embedded_png(stats_path.parent_path() / json_text(r, "file", source), title) +
                    "<figcaption>" + escaped(title) + "</figcaption></figure>\n";
        const json errors = r.value("visibility_error", json::object());
        rows += "<tr><td>" + escaped(json_text(r, "resolution", source)) + "</td><td>" + size + "</td><td>" +
                number_or_dash(r, "texel_px_on_screen", 1) + "</td><td>" + escaped(json_text(r, "filter", source)) +
                "</td><td>" + number_or_dash(r, "frame_ms", 1) + "</td><td>" + number_or_dash(r, "depth_ms", 1) +
                "</td><td>" + number_or_dash(r, "lighting_ms", 1) + "</td><td>" +
                number_or_dash(errors, "penumbra_rmse", 4) + "</td></tr>\n";
    }
    std::string difference;
    if (const auto found = stats.find("difference"); found != stats.end() && found->is_object()) {
        difference = "<figure>" +
                     embedded_png(stats_path.parent_path() / json_text(*found, "file", source), "difference") +
                     "<figcaption>Difference between the first and the last, × " + number_or_dash(*found, "scale", 0) +
                     ". Root mean square " + number_or_dash(*found, "rmse_levels", 2) +
                     " of 255 levels.</figcaption></figure>\n";
    }
    Page section(kRenderingsSection);
    section.text("scene", fs::path(json_text(stats, "scene", source)).filename().string())
        .text("technique", json_text(stats, "technique", source))
        .text("radius", number_or_dash(stats, "radius_px_on_screen", 1))
        .text("gl", json_text(stats, "renderer", source))
        .set("pictures", pictures)
        .set("rows", rows)
        .set("difference", difference);
    return section.html();
}

}  // namespace

std::string report_html(const std::vector<Trial>& trials, const LawFit& fit, const ReportInputs& inputs) {
    const Law& law = fit.law;
    const Trial& first = trials.front();
    Page page(embedded::report_template_html);
    page.text("study", first.study.empty() ? "A study" : first.study)
        .text("observers", std::to_string(law.observers) + " " + inputs.observer_kind +
                               (inputs.observer_kind.empty() ? "" : " ") + "observers")
        .text("trials", std::to_string(law.trials))
        .text("slope", format_fixed(law.slope, 2))
        .text("slope_low", format_fixed(law.slope_ci95.first, 2))
        .text("slope_high", format_fixed(law.slope_ci95.second, 2))
        .text("worst_case", describe(law.pattern, law.contrast))
        .text("kernel", std::string(name(law.kernel)))
        .text("percent", format_number(std::round(1000 * law.threshold_probability) / 10))
        .text("first_observer", first.observer)
        .text("first_condition", describe(first.condition.pattern, first.condition.contrast))
        .text("source", law.source)
        .set("law_rows", law_rows(law))
        .text("slope_method", law.conditions.empty() ? "" : law.conditions.front().slope_method)
        .set("comparisons", comparisons_table(law))
        .set("budget", budget_section(law))
        .set("warnings", warnings_list(fit.warnings))
        .set("law_figure", inline_svg(law_figure(fit)))
        .set("convergence_figure", inline_svg(convergence_figure(trials, fit)))
        .set("contact_sheet", inputs.contact_sheet.empty() ? "" : contact_sheet_section(inputs.contact_sheet))
        .set("renderings", inputs.render_stats.empty() ? "" : renderings_section(inputs.render_stats));
    return page.html();
}

}  // namespace stairstep
