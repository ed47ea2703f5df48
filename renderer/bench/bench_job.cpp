#include "renderer/bench/bench_job.h"

#include <algorithm>
#include <map>
#include <set>

#include "analysis/law/law_file.h"
#include "renderer/bench/bars.h"
#include "renderer/bench/bench_csv.h"
#include "renderer/bench/bench_page.h"
#include "renderer/bench/frontier_figure.h"
#include "renderer/box_slope.h"
#include "renderer/scenes/scenes.h"
#include "stimuli/error.h"
#include "stimuli/io/gnuplot.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"

namespace stairstep::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kTruck = "/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf";
/// Differences of visibility are shown this many times as strong.
constexpr int kDifferenceScale = 4;

/// A scene to measure, and how its rows and files are named.
struct Entry {
    std::string label;
    AnimatedScene animated;
    double radius = 0;
};

/// What a picture's file name ends in, and its caption.
struct Shown {
    Configuration configuration;
    std::string file;
};

std::vector<Shown> shown_configurations() {
    return {
        {auto_pcf(), "pcf-auto"}, {fixed_pcf(), "pcf-4096"}, {auto_pcss(), "pcss-auto"}, {fixed_pcss(), "pcss-4096"}};
}

double radius_of(const BenchJob& job, const AnimatedScene& animated) {
    if (!job.radius) return animated.radius;
    const double diagonal = caster_bounds(animated.scene, animated.state(Motion::still, 0)).diagonal();
    // Written so that NaN fails. Beyond the casters' own size the map would be all margin.
    if (!(*job.radius > 0 && *job.radius <= diagonal)) {
        throw InputError("--radius " + format_number(*job.radius),
                         "must be above 0 and at most the diagonal of " + animated.name,
                         "use one up to " + format_fixed(diagonal, 3) + " world units");
    }
    return *job.radius;
}

AnimatedScene load(const std::string& scene) {
    if (scene != "truck") return load_animated_scene(scene);
    if (!fs::is_regular_file(kTruck)) {
        throw InputError("truck", std::string(kTruck) + " isn't there", "install assimp-testmodels");
    }
    AnimatedScene animated = load_animated_scene(kTruck);
    animated.name = "truck";
    return animated;
}

/// What files may be called: a file's stem, told apart by a number where it isn't the first.
std::string label_of(const std::string& scene, const std::vector<Entry>& before) {
    std::string stem = fs::path(scene).stem().string();
    // Names of the list have no folder and no extension; a stem may hold what a page's links can't.
    for (char& c : stem) {
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
    }
    std::string label = stem;
    for (int i = 2; std::ranges::find(before, label, &Entry::label) != before.end(); ++i) {
        label = stem + "-" + std::to_string(i);
    }
    return label;
}

std::vector<Entry> load_scenes(const BenchJob& job) {
    if (job.scenes.empty()) throw InputError("--scenes", "is empty", "use for example crane,clutter");
    std::set<std::string> seen;
    for (const std::string& scene : job.scenes) {
        if (!seen.insert(scene).second)
            throw InputError("--scenes", "\"" + scene + "\" is listed twice", "list it once");
    }
    std::vector<Entry> entries;
    for (const std::string& scene : job.scenes) {
        AnimatedScene animated = load(scene);
        if (!animated.state(Motion::still, 0).more_lights.empty()) {
            throw InputError("--scenes", "\"" + scene + "\" has several lights, and truths are of one",
                             "leave it out; stairstep-render image draws it");
        }
        const double radius = radius_of(job, animated);
        entries.push_back({label_of(scene, entries), std::move(animated), radius});
    }
    return entries;
}

std::string figure_file(const Entry& entry) {
    return entry.label + "-frontier.svg";
}

std::string truth_file(const Entry& entry, TruthKind kind) {
    return entry.label + "-truth-" + std::string(name(kind)) + ".png";
}

std::string picture_file(const Entry& entry, const Shown& shown) {
    return entry.label + "-" + shown.file + ".png";
}

std::string difference_file(const Entry& entry, const Shown& shown) {
    return entry.label + "-" + shown.file + "-difference.png";
}

void probe_outputs(const BenchJob& job, const std::vector<Entry>& entries) {
    make_output_folder(job.out);
    std::vector<std::string> files{"bench.csv", "index.html"};
    for (const Entry& entry : entries) {
        files.push_back(figure_file(entry));
        for (const TruthKind kind : {TruthKind::area_light, TruthKind::box_filter, TruthKind::disk_filter}) {
            files.push_back(truth_file(entry, kind));
        }
        for (const Shown& shown : shown_configurations()) {
            files.push_back(picture_file(entry, shown));
            files.push_back(difference_file(entry, shown));
        }
    }
    for (const std::string& file : files) OutputFile probe(job.out / file);
    gnuplot_version();
}

/// The scene's truths, each made when first asked for.
class Truths {
  public:
    Truths(SceneTruth& truth, const SceneState& state, Progress& progress)
        : truth_(truth), state_(state), progress_(progress) {}

    const std::vector<float>& of(TruthKind kind) {
        const auto known = made_.find(kind);
        if (known != made_.end()) return known->second;
        progress_.advance();
        return made_[kind] = truth_.visibility(kind, state_);
    }

  private:
    SceneTruth& truth_;
    const SceneState& state_;
    Progress& progress_;
    std::map<TruthKind, std::vector<float>> made_;
};

std::vector<Picture> write_pictures(const BenchJob& job, const Entry& entry, const SceneMeasurements& scene,
                                    Truths& truths) {
    const int width = job.measurement.width;
    const int height = job.measurement.height;
    std::vector<Picture> pictures;
    const auto write = [&](const std::string& file, const Image& image, const std::string& caption) {
        write_png(job.out / file, image);
        pictures.push_back({file, caption});
    };
    // In rows of three: what it should be, what it is, how they differ.
    for (const Shown& shown : shown_configurations()) {
        const Measurement* one = find(scene.measurements, shown.configuration);
        if (!one) continue;
        const TruthKind kind = truth_of(shown.configuration);
        const Image truth = visibility_picture(truths.of(kind), width, height);
        write(truth_file(entry, kind), truth, "truth, " + std::string(name(kind)) + ": " + describe(kind, job.truth));
        const Image picture = visibility_picture(one->visibility, width, height);
        write(picture_file(entry, shown), picture,
              label(shown.configuration) + ", " + format_fixed(one->frame.cpu_ms, 1) + " ms");
        write(difference_file(entry, shown), difference_picture(picture, truth, kDifferenceScale),
              label(shown.configuration) + ": difference, times " + std::to_string(kDifferenceScale));
    }
    return pictures;
}

void measure_wobble(const BenchJob& job, const Entry& entry, const GpuScene& gpu_scene,
                    std::vector<Measurement>& measurements, Progress& progress) {
    const WobbleSettings& wobble = *job.wobble;
    SceneTruth truth(entry.animated.scene, gpu_scene, entry.radius, wobble.truth, wobble.width, wobble.height);
    for (const Shown& shown : shown_configurations()) {
        const auto one = std::ranges::find(measurements, shown.configuration, &Measurement::configuration);
        if (one != measurements.end()) {
            one->wobble =
                wobble_of(shown.configuration, job.measurement, wobble, entry.animated, gpu_scene, entry.radius, truth);
        }
        progress.advance();
    }
}

ordered_json describe(const SceneMeasurements& scene) {
    ordered_json json{{"scene", scene.scene}, {"radius", scene.radius}, {"configurations", scene.measurements.size()}};
    json["notes"] = scene.notes;
    json["dominated"] = dominated_by_law(scene.measurements);
    json["bars"] = ordered_json::array();
    for (const Bar& bar : bars_of(scene.measurements)) {
        json["bars"].push_back({{"what", bar.what}, {"met", bar.met}, {"figures", bar.figures}});
    }
    return json;
}

}  // namespace

BenchJob quick_job() {
    BenchJob job;
    job.scenes = {"crane", "clutter", "truck"};
    job.configurations = quick_configurations();
    job.measurement.frames = 5;
    job.truth.light_samples = 256;
    job.truth.filter_side = 4096;
    job.truth.filter_taps = 400;
    job.wobble->steps = 2;
    job.wobble->width = 160;
    job.wobble->height = 90;
    return job;
}

ordered_json run_bench(const BenchJob& job) {
    const Law law = law_named(job.law);
    MeasurementSettings settings = job.measurement;
    settings.law_slope = box_slope(law, job.law, job.convert_kernel);
    const std::vector<Entry> entries = load_scenes(job);
    probe_outputs(job, entries);
    const auto context = gl::make_context(job.context);
    const Setting setting{gl::renderer_name(), std::string(gl::name(job.context)),
                          settings.width,      settings.height,
                          settings.frames,     job.truth};
    BenchJob settled = job;
    settled.measurement = settings;

    std::vector<SceneMeasurements> scenes;
    std::vector<SceneFiles> files;
    const long steps_a_scene = static_cast<long>(job.configurations.size()) + 3 + (job.wobble ? 4 : 0);
    Progress progress("measuring", steps_a_scene * static_cast<long>(entries.size()));
    for (const Entry& entry : entries) {
        const GpuScene gpu_scene = upload(entry.animated.scene);
        const SceneState state = entry.animated.state(Motion::still, 0);
        SceneMeasurements scene{entry.label, entry.radius, {}, {}};
        {
            SceneTruth truth(entry.animated.scene, gpu_scene, entry.radius, job.truth, settings.width, settings.height);
            Truths truths(truth, state, progress);
            scene.measurements = measure(
                job.configurations, settings, {gpu_scene, state, entry.radius},
                [&](TruthKind kind) -> const std::vector<float>& { return truths.of(kind); }, scene.notes,
                [&] { progress.advance(); });
            find_frontiers(scene.measurements);
            files.push_back({figure_file(entry), write_pictures(settled, entry, scene, truths)});
        }
        if (job.wobble) measure_wobble(settled, entry, gpu_scene, scene.measurements, progress);
        write_file(job.out / figure_file(entry), frontier_figure(scene.measurements));
        for (Measurement& one : scene.measurements) one.visibility = {};
        scenes.push_back(std::move(scene));
        write_file(job.out / "bench.csv", bench_csv(scenes, setting));
        write_file(job.out / "index.html", bench_page(scenes, files, setting));
    }

    ordered_json result{{"program", "stairstep-render " STAIRSTEP_VERSION},
                        {"renderer", setting.renderer},
                        {"context", setting.context},
                        {"out", job.out.string()}};
    result["law"] = {{"file", job.law}, {"kernel", name(law.kernel)}, {"slope_for_box", settings.law_slope}};
    result["truth"] = {{"area_light", describe(TruthKind::area_light, job.truth)},
                       {"filter", describe(TruthKind::box_filter, job.truth)}};
    result["scenes"] = ordered_json::array();
    for (const SceneMeasurements& scene : scenes) result["scenes"].push_back(describe(scene));
    return result;
}

std::string summary_of(const ordered_json& result) {
    std::string text;
    for (const ordered_json& scene : result["scenes"]) {
        text += scene["scene"].get<std::string>() + ", " + std::to_string(scene["configurations"].get<size_t>()) +
                " configurations\n";
        for (const ordered_json& bar : scene["bars"]) {
            text += std::string(bar["met"].get<bool>() ? "  met      " : "  not met  ") +
                    bar["what"].get<std::string>() + ": " + bar["figures"].get<std::string>() + "\n";
        }
        for (const ordered_json& line : scene["dominated"]) text += "  " + line.get<std::string>() + "\n";
        for (const ordered_json& note : scene["notes"]) text += "  " + note.get<std::string>() + "\n";
    }
    const fs::path out = result["out"].get<std::string>();
    return text + (out / "index.html").string() + "\n";
}

}  // namespace stairstep::bench
