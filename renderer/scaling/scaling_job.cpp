#include "renderer/scaling/scaling_job.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "renderer/bench/measurement.h"
#include "renderer/scaling/box_field.h"
#include "renderer/scaling/scaling_csv.h"
#include "renderer/scaling/scaling_figure.h"
#include "renderer/scaling/scaling_page.h"
#include "stimuli/error.h"
#include "stimuli/io/gnuplot.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"

namespace stairstep::scaling {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// An axis at one of its values, on the GPU. Scenes and targets are shared by all values that have the same.
struct Stand {
    double value = 0;
    Scenario scenario;
    SceneState state;
    std::shared_ptr<const GpuScene> scene;
    std::shared_ptr<const FrameTarget> target;

    bench::Subject subject() const { return {*scene, state, scenario.radius}; }
};

std::vector<Stand> stands_of(const Axis& axis, const Scenario& start) {
    std::map<int, std::shared_ptr<const GpuScene>> scenes;
    std::map<std::pair<int, int>, std::shared_ptr<const FrameTarget>> targets;
    std::vector<Stand> stands;
    for (const double value : axis.values) {
        Stand stand;
        stand.scenario = start;
        stand.value = axis.apply(stand.scenario, value);
        stand.state = state_of(stand.scenario);
        auto& scene = scenes[stand.scenario.cells];
        if (!scene) scene = std::make_shared<const GpuScene>(upload(make_box_field(stand.scenario.cells)));
        stand.scene = scene;
        auto& target = targets[{stand.scenario.width, stand.scenario.height}];
        if (!target) {
            target = std::make_shared<const FrameTarget>(
                make_frame_target(Show::colour, stand.scenario.width, stand.scenario.height, 1));
        }
        stand.target = target;
        stands.push_back(std::move(stand));
    }
    return stands;
}

/// Techniques that are timed together, each at all values: what an exponent compares is drawn in the same rounds.
std::vector<std::vector<bench::Configuration>> groups_of(const std::vector<bench::Configuration>& techniques,
                                                         const std::vector<Stand>& stands, const ScalingJob& job) {
    std::vector<std::vector<bench::Configuration>> groups;
    double bytes = 0;
    for (const bench::Configuration& one : techniques) {
        double more = 0;
        for (const Stand& stand : stands) more += bench::map_bytes(one, job.largest_size) * stand.scenario.lights;
        if (groups.empty() || bytes + more > job.most_map_bytes) {
            groups.emplace_back();
            bytes = 0;
        }
        groups.back().push_back(one);
        bytes += more;
    }
    return groups;
}

Point point_of(const Stand& stand, const bench::TimedRenderer& timed) {
    Point point{stand.value, stand.scenario.width, stand.scenario.height, 0, 0, bench::median_times(timed)};
    if (timed.renderer.technique().reads_map()) {
        point.map_width = timed.renderer.map().shape.width;
        point.map_height = timed.renderer.map().shape.height;
    }
    return point;
}

AxisCurves measure(const Axis& axis, const ScalingJob& job, Progress& progress) {
    AxisCurves result{axis.name, axis.quantity, {}};
    const std::vector<Stand> stands = stands_of(axis, job.scenario);
    for (const auto& members : groups_of(techniques_on(axis, job.techniques), stands, job)) {
        std::vector<bench::TimedRenderer> group;
        for (const bench::Configuration& one : members) {
            for (const Stand& stand : stands) {
                bench::MeasurementSettings settings;
                settings.width = stand.scenario.width;
                settings.height = stand.scenario.height;
                settings.largest_size = job.largest_size;
                group.push_back({one, settled_renderer(one, settings, stand.subject(), *stand.target), stand.subject(),
                                 *stand.target});
                progress.advance();
            }
        }
        bench::time_in_turn(group, job.frames, [&] { progress.advance(); });
        for (size_t i = 0; i < group.size(); ++i) {
            const Stand& stand = stands[i % stands.size()];
            if (i % stands.size() == 0) result.curves.push_back({group[i].configuration, {}});
            result.curves.back().points.push_back(point_of(stand, group[i]));
        }
    }
    return result;
}

void check(const ScalingJob& job) {
    if (job.axes.empty()) throw InputError("--axes", "is empty", "use for example radius,height");
    std::set<std::string> seen;
    for (const Axis& axis : job.axes) {
        if (!seen.insert(axis.name).second) {
            throw InputError("--axes", "\"" + axis.name + "\" is listed twice", "list it once");
        }
    }
}

void probe_outputs(const ScalingJob& job) {
    make_output_folder(job.out);
    std::vector<std::string> files{"scaling.csv", "index.html"};
    for (const Axis& axis : job.axes) files.push_back(figure_file(axis.name));
    for (const std::string& file : files) OutputFile probe(job.out / file);
    gnuplot_version();
}

std::string describe(const Scenario& scenario) {
    const size_t triangles = triangle_count(make_box_field(scenario.cells));
    return std::to_string(scenario.width) + " × " + std::to_string(scenario.height) + " pixels, " +
           std::to_string(triangles) + " triangles, a filter of half-width " + format_number(scenario.radius) + " m, " +
           std::to_string(scenario.lights) + (scenario.lights == 1 ? " light" : " lights") + " of half-tangent " +
           format_number(scenario.half_tangent);
}

void put(ordered_json& json, const PowerLaw& law) {
    json["exponent"] = law.exponent;
    json["exponent_se"] = law.exponent_se ? ordered_json(*law.exponent_se) : ordered_json();
}

ordered_json describe(const Curve& curve) {
    ordered_json json{{"technique", curve.configuration.technique},
                      {"size", size_of(curve.configuration)},
                      {"taps", curve.configuration.taps}};
    put(json, frame_law(curve));
    json["growth"] = growth_of(curve);
    json["value"] = json["frame_ms"] = json["texels"] = ordered_json::array();
    for (const Point& point : curve.points) {
        json["value"].push_back(point.value);
        json["frame_ms"].push_back(point.times.frame.cpu_ms);
        json["texels"].push_back(point.texels());
    }
    json["parts"] = ordered_json::object();
    for (const Part& part : parts().subspan(1)) {
        if (const std::optional<PowerLaw> law = law_of(curve, part)) put(json["parts"][part.name], *law);
    }
    return json;
}

}  // namespace

ScalingJob quick_job() {
    ScalingJob job;
    for (Axis& axis : job.axes) axis.values = axis.quick_values;
    std::erase_if(job.techniques, [](const bench::Configuration& one) { return one.entry == "hard"; });
    job.scenario.width = 640;
    job.scenario.height = 360;
    job.frames = 3;
    return job;
}

ordered_json run_scaling(const ScalingJob& job) {
    check(job);
    probe_outputs(job);
    const auto context = gl::make_context(job.context);
    const Setting setting{gl::renderer_name(), std::string(gl::name(job.context)), job.frames};

    long renderers = 0;
    for (const Axis& axis : job.axes) {
        renderers += static_cast<long>(axis.values.size() * techniques_on(axis, job.techniques).size());
    }
    Progress progress("measuring", renderers * (1 + job.frames));
    std::vector<AxisCurves> done;
    for (const Axis& axis : job.axes) {
        done.push_back(measure(axis, job, progress));
        write_file(job.out / figure_file(axis.name), scaling_figure(done.back()));
        write_file(job.out / "scaling.csv", scaling_csv(done, setting));
        write_file(job.out / "index.html", scaling_page(done, setting, describe(job.scenario)));
    }

    ordered_json result{{"program", "stairstep-render " STAIRSTEP_VERSION},
                        {"renderer", setting.renderer},
                        {"context", setting.context},
                        {"out", job.out.string()},
                        {"frames", job.frames},
                        {"scenario", describe(job.scenario)},
                        {"axes", ordered_json::array()}};
    for (const AxisCurves& axis : done) {
        ordered_json json{{"axis", axis.axis}, {"quantity", axis.quantity}, {"techniques", ordered_json::array()}};
        for (const Curve& curve : axis.curves) json["techniques"].push_back(describe(curve));
        result["axes"].push_back(json);
    }
    return result;
}

std::string summary_of(const ordered_json& result) {
    std::string text;
    for (const ordered_json& axis : result["axes"]) {
        text += axis["axis"].get<std::string>() + " (" + axis["quantity"].get<std::string>() + ")\n";
        for (const ordered_json& one : axis["techniques"]) {
            std::string name = one["technique"].get<std::string>();
            if (one["size"] != "none") name += " " + one["size"].get<std::string>();
            name.resize(std::max<size_t>(name.size(), 20), ' ');
            PowerLaw law;
            law.exponent = one["exponent"];
            if (!one["exponent_se"].is_null()) law.exponent_se = one["exponent_se"].get<double>();
            text += "  " + name + " exponent " + exponent_text(law) + ", time x " +
                    format_fixed(one["growth"].get<double>(), 2) + " from first to last\n";
        }
    }
    const fs::path out = result["out"].get<std::string>();
    return text + (out / "index.html").string() + "\n";
}

}  // namespace stairstep::scaling
