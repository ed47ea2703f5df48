#include "renderer/bench/bench_page.h"

#include <cassert>

#include "embedded/bench_page.h"
#include "renderer/bench/bars.h"
#include "stimuli/io/html.h"
#include "stimuli/number.h"

namespace stairstep::bench {
namespace {

/// Longer tables are folded.
constexpr size_t kMostOpenRows = 20;

void replace(std::string& html, const std::string& place, const std::string& value) {
    const std::string mark = "{{" + place + "}}";
    const size_t at = html.find(mark);
    assert(at != std::string::npos);
    html.replace(at, mark.size(), value);
}

std::string table_row(const Measurement& one) {
    const std::string kind = one.configuration.side ? "" : "law ";
    std::string html = "<tr class=\"" + kind + (one.on_frontier ? "best" : "") + "\">";
    const auto cell = [&](const std::string& text) { html += "<td>" + escaped(text) + "</td>"; };
    cell(label(one.configuration));
    cell(one.width ? std::to_string(one.width) + " × " + std::to_string(one.height) : "");
    const std::string search = one.lookups.search ? std::to_string(one.lookups.search) + "+" : "";
    cell(one.lookups.filter ? search + std::to_string(one.lookups.filter) +
                                  (one.lookups.gathers       ? " gathers"
                                   : one.lookups.filter == 1 ? " tap"
                                                             : " taps")
                            : "");
    cell(format_fixed(one.frame.cpu_ms, 1));
    cell(format_fixed(one.depth.cpu_ms, 1));
    cell(format_fixed(one.prepare.cpu_ms, 1));
    cell(format_fixed(one.lighting.cpu_ms, 1));
    cell(format_fixed(one.need.cpu_ms, 1));
    cell(format_fixed(one.time_ratio, 2));
    cell(format_fixed(one.error.rmse, 4));
    cell(format_fixed(one.error.penumbra_rmse, 4));
    cell(format_fixed(one.error.max, 3));
    cell(format_fixed(100 * one.error.share_over_8_levels, 1));
    cell(one.wobble ? format_fixed(one.wobble->mean(), 5) : "");
    return html + "</tr>\n";
}

std::string table(const std::vector<Measurement>& measurements) {
    std::string html = "<table>\n<thead><tr>";
    for (const char* head : {"configuration", "map", "lookups", "frame ms", "depth", "prepare", "lighting", "need", "×",
                             "error", "penumbra", "max", "> 8/255 %", "wobble"}) {
        html += "<th>" + escaped(head) + "</th>";
    }
    html += "</tr></thead>\n<tbody>\n";
    for (const Measurement& one : measurements) html += table_row(one);
    return html + "</tbody></table>\n";
}

std::string scene_section(const SceneMeasurements& scene, const SceneFiles& files) {
    std::string html = "<h2>" + escaped(scene.scene) + "</h2>\n<ul class=\"bars\">\n";
    for (const Bar& bar : bars_of(scene.measurements)) {
        html += std::string("<li><span class=\"") + (bar.met ? "met\">met" : "missed\">not met") + "</span>" +
                escaped(bar.what) + ": " + escaped(bar.figures) + "</li>\n";
    }
    html += "</ul>\n";
    for (const std::string& line : dominated_by_law(scene.measurements)) html += "<p>" + escaped(line) + "</p>\n";
    html += "<figure><img src=\"" + escaped(files.figure) +
            "\" alt=\"Frame time against error\"><figcaption>Filled: maps sized by the law, with their taps. Open: "
            "fixed maps. Grey: the frontier.</figcaption></figure>\n";
    const std::string rows = "<div class=\"wide\">" + table(scene.measurements) + "</div>\n";
    const size_t count = scene.measurements.size();
    html += count <= kMostOpenRows ? rows
                                   : "<details><summary>All " + std::to_string(count) + " configurations</summary>\n" +
                                         rows + "</details>\n";
    for (const std::string& note : scene.notes) html += "<p class=\"subtitle\">" + escaped(note) + ".</p>\n";
    html += "<div class=\"pictures\">\n";
    for (const Picture& picture : files.pictures) {
        html += "<figure><img src=\"" + escaped(picture.file) + "\" alt=\"" + escaped(picture.caption) +
                "\"><figcaption>" + escaped(picture.caption) + "</figcaption></figure>\n";
    }
    return html + "</div>\n";
}

}  // namespace

std::vector<std::string> dominated_by_law(const std::vector<Measurement>& measurements) {
    std::vector<std::string> lines;
    for (const Configuration& configuration : {auto_pcf(), auto_pcss()}) {
        const Measurement* one = find(measurements, configuration);
        if (!one || !one->dominator) continue;
        const Measurement& better = measurements[*one->dominator];
        lines.push_back(label(configuration) + " is not on the frontier: " + label(better.configuration) + " takes " +
                        format_fixed(better.frame.cpu_ms, 1) + " ms at an error of " +
                        format_fixed(better.error.rmse, 4) + ", it takes " + format_fixed(one->frame.cpu_ms, 1) +
                        " ms at " + format_fixed(one->error.rmse, 4) + ".");
    }
    return lines;
}

std::string bench_page(const std::vector<SceneMeasurements>& scenes, const std::vector<SceneFiles>& files,
                       const Setting& setting) {
    assert(scenes.size() == files.size());
    std::string html(embedded::bench_page_html);
    replace(html, "setting",
            escaped(std::to_string(setting.width) + " × " + std::to_string(setting.height) + " pixels · " +
                    setting.renderer + " · " + setting.context));
    replace(html, "frames", std::to_string(setting.frames));
    replace(html, "light_quality", describe(TruthKind::area_light, setting.truth));
    replace(html, "filter_quality", describe(TruthKind::box_filter, setting.truth));
    std::string sections;
    for (size_t i = 0; i < scenes.size(); ++i) sections += scene_section(scenes[i], files[i]);
    replace(html, "scenes", sections);
    return html;
}

}  // namespace stairstep::bench
