#include "analysis/law/law_file.h"

#include <cmath>

#include "embedded/law.h"
#include "stimuli/error.h"
#include "stimuli/io/json_file.h"

namespace stairstep {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kFormat = "stairstep-law/1";

[[noreturn]] void reject(const std::string& source, const std::string& problem, const std::string& remedy) {
    throw InputError(source, problem, remedy);
}

Pattern pattern_at(const json& object, const std::string& source) {
    const std::string text = json_text(object, "pattern", source);
    for (const Pattern pattern : {Pattern::step, Pattern::stair}) {
        if (name(pattern) == text) return pattern;
    }
    reject(source, "\"pattern\" is \"" + text + "\"", "use step or stair");
}

KernelShape kernel_at(const json& object, const std::string& source) {
    const std::string text = json_text(object, "kernel", source);
    if (const auto shape = kernel_shape_named(text)) return *shape;
    reject(source, "\"kernel\" is \"" + text + "\"", "use box, disk, gaussian or poisson");
}

double positive_at(const json& object, const std::string& key, const std::string& source) {
    const double value = json_number(object, key, source);
    if (!(value > 0)) reject(source, "\"" + key + "\" must be above 0", "fit the law again");
    return value;
}

double contrast_at(const json& object, const std::string& source) {
    const double contrast = positive_at(object, "contrast", source);
    if (contrast > 1) reject(source, "\"contrast\" must be at most 1", "fit the law again");
    return contrast;
}

int count_at(const json& object, const std::string& key, const std::string& source) {
    const double value = json_number(object, key, source);
    if (!(value >= 0) || value > 2e9 || value != static_cast<int>(value)) {
        reject(source, "\"" + key + "\" must be a whole number, 0 or above", "fit the law again");
    }
    return static_cast<int>(value);
}

/// c and its interval; both levels of the file state them alike.
template <typename L>
void read_slope(L& law, const json& object, const std::string& source) {
    law.slope = positive_at(object, "slope", source);
    law.slope_ci95 = json_range(object, "slope_ci95", source);
    if (law.slope < law.slope_ci95.first || law.slope > law.slope_ci95.second) {
        reject(source, "\"slope\" lies outside \"slope_ci95\"", "fit the law again");
    }
    law.pattern = pattern_at(object, source);
    law.contrast = contrast_at(object, source);
    law.kernel = kernel_at(object, source);
    law.observers = count_at(object, "observers", source);
    law.trials = count_at(object, "trials", source);
}

ConditionLaw condition_from(const json& object, const std::string& source) {
    if (!object.is_object()) reject(source, "is no object", "fit the law again");
    ConditionLaw law;
    read_slope(law, object, source);
    law.has_form = object.contains("intercept_px") || object.contains("exponent");
    if (law.has_form) {
        law.intercept_px = json_number(object, "intercept_px", source);
        law.intercept_ci95 = json_range(object, "intercept_ci95", source);
        law.exponent = json_number(object, "exponent", source);
        law.exponent_ci95 = json_range(object, "exponent_ci95", source);
    }
    if (object.contains("between_observer_sd_ln")) {
        law.between_observer_sd_ln = json_number(object, "between_observer_sd_ln", source);
    }
    return law;
}

Law law_from(const json& object, const std::string& source) {
    if (const std::string format = json_text(object, "format", source); format != kFormat) {
        reject(source, "\"format\" is \"" + format + "\"", std::string("this program reads ") + kFormat);
    }
    Law law;
    read_slope(law, object, source);
    law.threshold_probability = positive_at(object, "threshold_probability", source);
    if (law.threshold_probability >= 1) {
        reject(source, "\"threshold_probability\" must be below 1", "fit the law again");
    }
    law.texel_range_px = json_range(object, "texel_range_px", source);
    law.source = json_text(object, "source", source);
    const auto conditions = object.find("conditions");
    if (conditions == object.end() || !conditions->is_array()) {
        reject(source, "\"conditions\" is no list", "use [] where there are none");
    }
    for (const json& condition : *conditions) {
        law.conditions.push_back(
            condition_from(condition, source + ", conditions[" + std::to_string(law.conditions.size()) + "]"));
    }
    return law;
}

json pair_of(const Interval& interval) {
    return json::array({interval.first, interval.second});
}

ordered_json to_json(const ConditionLaw& law);

template <typename T, typename... Args>
ordered_json list_of(const std::vector<T>& values, const Args&... args) {
    ordered_json list = ordered_json::array();
    for (const T& value : values) list.push_back(to_json(value, args...));
    return list;
}

ordered_json to_json(const ConditionLaw& law) {
    ordered_json json{{"pattern", name(law.pattern)},
                      {"contrast", law.contrast},
                      {"kernel", name(law.kernel)},
                      {"slope", law.slope},
                      {"slope_ci95", pair_of(law.slope_ci95)},
                      {"slope_method", law.slope_method}};
    if (law.has_form) {
        json["intercept_px"] = law.intercept_px;
        json["intercept_ci95"] = pair_of(law.intercept_ci95);
        json["exponent"] = law.exponent;
        json["exponent_ci95"] = pair_of(law.exponent_ci95);
    }
    json["form_method"] = law.form_method;
    json["between_observer_sd_ln"] = law.between_observer_sd_ln;
    json["tau_ln"] = law.tau_ln;
    json["observers"] = law.observers;
    json["trials"] = law.trials;
    json["estimates"] = list_of(law.estimates);
    json["observer_slopes"] = list_of(law.observer_slopes);
    json["leave_one_observer_out"] = list_of(law.without_observer, std::string("observer"));
    json["leave_one_size_out"] = list_of(law.without_size, std::string("texel_px"));
    json["down_weighted"] = list_of(law.down_weighted);
    return json;
}

/// JSON has no NaN and no infinity; written anyway they would turn into null without a word.
void require_finite(const ordered_json& value, const std::string& key, const std::string& source) {
    if (value.is_number_float() && !std::isfinite(value.get<double>())) {
        throw FailureError(source, "\"" + key + "\" is no finite number", "look for thresholds that are out of range");
    }
    if (!value.is_structured()) return;
    for (const auto& [inner, part] : value.items()) {
        require_finite(part, value.is_array() ? key + "[" + inner + "]" : inner, source);
    }
}

}  // namespace

Law read_law(const std::filesystem::path& path) {
    return law_from(read_json(path), path.string());
}

Law law_from_json(std::string_view text, const std::string& source) {
    return law_from(parse_json(text, source), source);
}

Law kreuzer2017_law() {
    return law_from_json(embedded::kreuzer2017_json, "kreuzer2017.json");
}

Law law_named(const std::string& path_or_name) {
    return path_or_name == "kreuzer2017" ? kreuzer2017_law() : read_law(path_or_name);
}

void write_law(const std::filesystem::path& path, const Law& law) {
    write_law(path, law, ordered_json::object());
}

ordered_json to_json(const Law& law) {
    ordered_json file{{"format", kFormat},
                      {"kernel", name(law.kernel)},
                      {"slope", law.slope},
                      {"slope_ci95", pair_of(law.slope_ci95)},
                      {"threshold_probability", law.threshold_probability},
                      {"pattern", name(law.pattern)},
                      {"contrast", law.contrast},
                      {"texel_range_px", pair_of(law.texel_range_px)},
                      {"observers", law.observers},
                      {"trials", law.trials},
                      {"source", law.source},
                      {"conditions", list_of(law.conditions)}};
    if (!law.slope_method.empty()) file["slope_method"] = law.slope_method;
    if (!law.comparisons.empty()) file["comparisons"] = list_of(law.comparisons);
    if (!law.criteria.empty()) file["criteria"] = list_of(law.criteria);
    return file;
}

void write_law(const std::filesystem::path& path, const Law& law, const ordered_json& more) {
    ordered_json file = to_json(law);
    for (const auto& [key, value] : more.items()) file[key] = value;
    require_finite(file, "law", path.string());
    write_json(path, file);
}

double slope_for_kernel(const Law& law, KernelShape kernel) {
    return law.slope * axis_deviation(law.kernel) / axis_deviation(kernel);
}

}  // namespace stairstep
