#include "renderer/bench/bench_csv.h"

#include <algorithm>

#include "stimuli/io/csv.h"
#include "stimuli/number.h"

namespace stairstep::bench {
namespace {

/// A column: its name, and its field of a row.
struct Row {
    const SceneMeasurements& scene;
    const Measurement& one;
    const Setting& setting;
};
struct Column {
    const char* name;
    std::string (*field)(const Row& row);
};

std::string number(double value) {
    return format_number(value);
}

std::string yes_no(bool value) {
    return value ? "1" : "0";
}

int resolution_of(const Measurement& one) {
    if (one.width == 0) return 0;
    return one.configuration.side.value_or(std::max(one.width, one.height));
}

const std::vector<Column>& columns() {
    static const std::vector<Column> list{
        {"scene", [](const Row& r) { return r.scene.scene; }},
        {"technique", [](const Row& r) { return r.one.configuration.technique; }},
        {"sizing", [](const Row& r) { return sizing_of(r.one.configuration); }},
        {"resolution", [](const Row& r) { return number(resolution_of(r.one)); }},
        {"search_taps", [](const Row& r) { return number(r.one.lookups.search); }},
        {"filter_taps", [](const Row& r) { return number(r.one.lookups.filter); }},
        {"frame_ms", [](const Row& r) { return number(r.one.frame.cpu_ms); }},
        {"depth_ms", [](const Row& r) { return number(r.one.depth.cpu_ms); }},
        {"lighting_ms", [](const Row& r) { return number(r.one.lighting.cpu_ms); }},
        {"texels", [](const Row& r) { return number(r.one.texels()); }},
        {"error_rmse", [](const Row& r) { return number(r.one.error.rmse); }},
        {"error_max", [](const Row& r) { return number(r.one.error.max); }},
        {"filter",
         [](const Row& r) {
             const std::string& technique = r.one.configuration.entry;
             if (technique == "none" || technique == "hard") return std::string("none");
             if (r.one.lookups.prefiltered) return std::string("prefiltered");
             return std::string(name(r.one.configuration.filter));
         }},
        {"lookups", [](const Row& r) { return std::string(r.one.lookups.gathers ? "gathers" : "taps"); }},
        {"limited_by", [](const Row& r) { return r.one.limited_by; }},
        {"fit_ms", [](const Row& r) { return number(r.one.fit_ms); }},
        {"prepare_ms", [](const Row& r) { return number(r.one.prepare.cpu_ms); }},
        {"need_ms", [](const Row& r) { return number(r.one.need.cpu_ms); }},
        {"gpu_frame_ms", [](const Row& r) { return number(r.one.frame.gpu_ms); }},
        {"gpu_depth_ms", [](const Row& r) { return number(r.one.depth.gpu_ms); }},
        {"gpu_prepare_ms", [](const Row& r) { return number(r.one.prepare.gpu_ms); }},
        {"gpu_lighting_ms", [](const Row& r) { return number(r.one.lighting.gpu_ms); }},
        {"gpu_need_ms", [](const Row& r) { return number(r.one.need.gpu_ms); }},
        {"width", [](const Row& r) { return number(r.one.width); }},
        {"height", [](const Row& r) { return number(r.one.height); }},
        {"penumbra_rmse", [](const Row& r) { return number(r.one.error.penumbra_rmse); }},
        {"share_over_1_level", [](const Row& r) { return number(r.one.error.share_over_1_level); }},
        {"share_over_8_levels", [](const Row& r) { return number(r.one.error.share_over_8_levels); }},
        {"rmse_levels", [](const Row& r) { return number(r.one.rmse_levels); }},
        {"wobble", [](const Row& r) { return r.one.wobble ? number(r.one.wobble->mean()) : std::string(); }},
        {"wobble_light", [](const Row& r) { return r.one.wobble ? number(r.one.wobble->light) : std::string(); }},
        {"wobble_caster", [](const Row& r) { return r.one.wobble ? number(r.one.wobble->caster) : std::string(); }},
        {"wobble_camera", [](const Row& r) { return r.one.wobble ? number(r.one.wobble->camera) : std::string(); }},
        {"time_ratio", [](const Row& r) { return number(r.one.time_ratio); }},
        {"on_frontier", [](const Row& r) { return yes_no(r.one.on_frontier); }},
        {"truth", [](const Row& r) { return std::string(name(truth_of(r.one.configuration))); }},
        {"truth_quality", [](const Row& r) { return describe(truth_of(r.one.configuration), r.setting.truth); }},
        {"radius", [](const Row& r) { return number(r.scene.radius); }},
        {"picture_width", [](const Row& r) { return number(r.setting.width); }},
        {"picture_height", [](const Row& r) { return number(r.setting.height); }},
        {"frames", [](const Row& r) { return number(r.setting.frames); }},
        {"renderer", [](const Row& r) { return r.setting.renderer; }},
        {"context", [](const Row& r) { return r.setting.context; }},
        {"light_bleeding", [](const Row& r) { return number(r.one.error.light_bleeding); }},
        {"surfaces_ms", [](const Row& r) { return number(r.one.surfaces.cpu_ms); }},
        {"no_skip", [](const Row& r) { return r.one.configuration.no_skip; }},
    };
    return list;
}

}  // namespace

std::string sizing_of(const Configuration& configuration) {
    return configuration.side ? "fixed" : "auto";
}

std::string bench_csv(const std::vector<SceneMeasurements>& scenes, const Setting& setting) {
    CsvWriter csv;
    std::vector<std::string> fields;
    for (const Column& column : columns()) fields.emplace_back(column.name);
    csv.row(fields);
    for (const SceneMeasurements& scene : scenes) {
        for (const Measurement& one : scene.measurements) {
            fields.clear();
            for (const Column& column : columns()) fields.push_back(column.field({scene, one, setting}));
            csv.row(fields);
        }
    }
    return csv.text();
}

}  // namespace stairstep::bench
