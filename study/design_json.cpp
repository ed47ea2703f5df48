#include "study/design_json.h"

#include <algorithm>
#include <cmath>

#include "stimuli/error.h"
#include "stimuli/io/json_file.h"
#include "stimuli/io/json_object.h"
#include "stimuli/io/output_file.h"
#include "study/engine_json.h"

namespace stairstep {
namespace {

using nlohmann::ordered_json;

std::optional<Pattern> pattern_named(const std::string& text) {
    for (const Pattern pattern : {Pattern::step, Pattern::stair}) {
        if (name(pattern) == text) return pattern;
    }
    return std::nullopt;
}

void read_patterns(JsonObject& object, std::vector<Pattern>& patterns) {
    std::vector<std::string> names;
    for (const Pattern pattern : patterns) names.emplace_back(name(pattern));
    object.read("patterns", names);
    patterns.clear();
    for (const std::string& text : names) {
        const auto pattern = pattern_named(text);
        if (!pattern) object.reject("patterns", "\"" + text + "\" is unknown", "use step or stair");
        patterns.push_back(*pattern);
    }
}

void read_task(JsonObject object, Design& design) {
    object.read_named("name", design.task, task_named, "yes-no or 2afc");
    object.read("line_share", design.line_share);
    object.refuse_other_keys();
}

void read_engine(JsonObject object, Design& design) {
    object.read("guess_radius_texels", design.guess_radius_texels);
    read_engine(object, design.engine);
    object.refuse_other_keys();
}

void read_stop(JsonObject object, StopRule& stop) {
    object.read("most_trials", stop.most_trials);
    // Whoever wants two trials a track needn't say that the least is not ten.
    if (!object.contains("least_trials")) stop.least_trials = std::min(stop.least_trials, stop.most_trials);
    object.read("least_trials", stop.least_trials);
    object.read("converged_sd", stop.converged_sd);
    object.refuse_other_keys();
}

/// Two numbers where there are any.
template <typename T>
void read_pair(JsonObject& object, const std::string& key, T& first, T& second) {
    std::vector<double> pair{static_cast<double>(first), static_cast<double>(second)};
    object.read(key, pair);
    if (pair.size() != 2) object.reject(key, "isn't a list of two", "write for example [640, 480]");
    for (const double value : pair) {
        if (std::is_integral_v<T> && !(std::abs(value) < 2e9 && value == std::floor(value))) {
            object.reject(key, "holds something else than whole numbers", "write for example [640, 480]");
        }
    }
    first = static_cast<T>(pair[0]);
    second = static_cast<T>(pair[1]);
}

void read_viewing(JsonObject object, Design& design) {
    design.viewing.emplace();
    object.read("distance_mm", design.viewing->distance_mm);
    object.read("pixel_pitch_mm", design.viewing->pixel_pitch_mm);
    object.refuse_other_keys();
}

}  // namespace

ordered_json to_json(const Design& design) {
    ordered_json patterns = ordered_json::array();
    for (const Pattern pattern : design.patterns) patterns.push_back(name(pattern));
    ordered_json task{{"name", name(design.task)}};
    if (design.task == Task::yes_no) task["line_share"] = design.line_share;
    ordered_json engine;
    add_engine(engine, design.engine);
    engine["guess_radius_texels"] = design.guess_radius_texels;
    ordered_json stop{{"least_trials", design.stop.least_trials}, {"most_trials", design.stop.most_trials}};
    if (design.stop.converged_sd) stop["converged_sd"] = *design.stop.converged_sd;

    ordered_json object{{"name", design.name},
                        {"patterns", patterns},
                        {"contrasts", design.contrasts},
                        {"texels_px", design.texels_px},
                        {"kernel", name(design.kernel)},
                        {"task", task},
                        {"engine", engine},
                        {"stop", stop},
                        {"practice_trials", design.easy.practice_trials},
                        {"catch_share", design.easy.catch_share},
                        {"easy_radius_texels", design.easy.radius_texels},
                        {"break_every_trials", design.break_every_trials},
                        {"radius_px", {design.smallest_radius_px, design.largest_radius_px}},
                        {"size_px", {design.width_px, design.height_px}}};
    if (design.viewing) {
        object["viewing"] = {{"distance_mm", design.viewing->distance_mm},
                             {"pixel_pitch_mm", design.viewing->pixel_pitch_mm}};
    }
    return object;
}

Design design_from_json(const std::string& text, const std::string& source) {
    JsonObject object(parse_json(text, source), source);
    Design design;
    object.read("name", design.name);
    read_patterns(object, design.patterns);
    object.read("contrasts", design.contrasts);
    object.read("texels_px", design.texels_px);
    object.read_named("kernel", design.kernel, kernel_shape_named, "box, disk, gaussian or poisson");
    read_task(object.object("task"), design);
    read_engine(object.object("engine"), design);
    read_stop(object.object("stop"), design.stop);
    object.read("practice_trials", design.easy.practice_trials);
    object.read("catch_share", design.easy.catch_share);
    object.read("easy_radius_texels", design.easy.radius_texels);
    object.read("break_every_trials", design.break_every_trials);
    read_pair(object, "radius_px", design.smallest_radius_px, design.largest_radius_px);
    read_pair(object, "size_px", design.width_px, design.height_px);
    if (object.contains("viewing")) read_viewing(object.object("viewing"), design);
    object.refuse_other_keys();
    require_valid(design, source);
    return design;
}

Design read_design(const std::filesystem::path& path) {
    return design_from_json(read_file(path), path.string());
}

}  // namespace stairstep
