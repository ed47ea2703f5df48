#include "analysis/report_renderings.h"

#include "analysis/report_page.h"
#include "stimuli/error.h"
#include "stimuli/io/json_file.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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

}  // namespace

std::string contact_sheet_section(const std::string& path) {
    return "<h2>What the observers judge</h2>\n<figure>" +
           embedded_png(path, "contact sheet of filtered shadow edges") +
           "<figcaption>Filtered shadow edges, at half size. Down a column the texel grows and the steps come back; "
           "along "
           "a row the filter grows and they vanish. They vanish where the radius is the same number of texels, "
           "whatever the "
           "texel's size.</figcaption></figure>\n";
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

}  // namespace stairstep
