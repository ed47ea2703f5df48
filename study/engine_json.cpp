#include "study/engine_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace stairstep {
namespace {

using nlohmann::ordered_json;

constexpr std::pair<QuestPlacement, const char*> kPlacements[] = {
    {QuestPlacement::most_informative, "most-informative"},
    {QuestPlacement::mean, "mean"},
    {QuestPlacement::mode, "mode"},
    {QuestPlacement::quantile, "quantile"},
};

std::optional<QuestPlacement> placement_named(const std::string& text) {
    for (const auto& [placement, name] : kPlacements) {
        if (text == name) return placement;
    }
    return std::nullopt;
}

const char* name(QuestPlacement placement) {
    for (const auto& [known, name] : kPlacements) {
        if (known == placement) return name;
    }
    return "";
}

// What several engines have.

void add_posterior(ordered_json& object, const QuestSettings& s) {
    object["prior"] = s.log_prior ? "uniform" : "normal";
    object["guess_sd"] = s.guess_sd;
    object["p_threshold"] = s.shape.p_threshold;
    object["beta"] = s.shape.beta;
    object["gamma"] = s.shape.gamma;
    object["delta"] = s.shape.delta;
    object["grain"] = s.grain;
    object["range"] = s.range;
}

void read_posterior(JsonObject& object, QuestSettings& s) {
    std::string prior = s.log_prior ? "uniform" : "normal";
    object.read("prior", prior);
    if (prior != "uniform" && prior != "normal") {
        object.reject("prior", "\"" + prior + "\" is unknown", "use normal or uniform");
    }
    s.log_prior = prior == "uniform" ? uniform_log_prior() : nullptr;
    object.read("guess_sd", s.guess_sd);
    object.read("p_threshold", s.shape.p_threshold);
    object.read("beta", s.shape.beta);
    object.read("gamma", s.shape.gamma);
    object.read("delta", s.shape.delta);
    object.read("grain", s.grain);
    object.read("range", s.range);
}

void read_interval(JsonObject& object, const std::string& key, double& low, double& high) {
    std::vector<double> pair{low, high};
    object.read(key, pair);
    if (pair.size() != 2) object.reject(key, "isn't a list of two", "write the lowest and the highest");
    low = pair[0];
    high = pair[1];
}

// For each engine: its name, and its settings to JSON and back.

const char* name(const QuestSettings&) {
    return "quest";
}

void add(ordered_json& object, const QuestSettings& s) {
    add_posterior(object, s);
    object["placement"] = name(s.placement);
    if (s.quantile_order) object["quantile_order"] = *s.quantile_order;
}

void read(JsonObject& object, QuestSettings& s) {
    read_posterior(object, s);
    object.read_named("placement", s.placement, placement_named, "most-informative, mean, mode or quantile");
    object.read("quantile_order", s.quantile_order);
}

const char* name(const MinimumEntropySettings&) {
    return "minimum-entropy";
}

void add(ordered_json& object, const MinimumEntropySettings& s) {
    add_posterior(object, s.posterior);
    object.erase("prior");
}

void read(JsonObject& object, MinimumEntropySettings& s) {
    if (object.contains("prior")) object.reject("prior", "can't be chosen for this engine", "leave it out");
    read_posterior(object, s.posterior);
}

const char* name(const PsiMarginalSettings&) {
    return "psi-marginal";
}

void add(ordered_json& object, const PsiMarginalSettings& s) {
    object["guess_sd"] = s.guess_sd;
    object["p_threshold"] = s.p_threshold;
    object["grain"] = s.grain;
    object["range"] = s.range;
    object["beta"] = {s.beta_low, s.beta_high};
    object["beta_count"] = s.beta_count;
    object["beta_guess"] = s.beta_guess;
    object["beta_log_sd"] = s.beta_log_sd;
    object["delta"] = {s.delta_low, s.delta_high};
    object["delta_count"] = s.delta_count;
    object["delta_scale"] = s.delta_scale;
    object["gamma"] = {s.gamma_low, s.gamma_high};
    object["gamma_count"] = s.gamma_count;
    object["learn_slope"] = s.learn_slope;
}

void read(JsonObject& object, PsiMarginalSettings& s) {
    object.read("guess_sd", s.guess_sd);
    object.read("p_threshold", s.p_threshold);
    object.read("grain", s.grain);
    object.read("range", s.range);
    read_interval(object, "beta", s.beta_low, s.beta_high);
    object.read("beta_count", s.beta_count);
    object.read("beta_guess", s.beta_guess);
    object.read("beta_log_sd", s.beta_log_sd);
    read_interval(object, "delta", s.delta_low, s.delta_high);
    object.read("delta_count", s.delta_count);
    object.read("delta_scale", s.delta_scale);
    read_interval(object, "gamma", s.gamma_low, s.gamma_high);
    object.read("gamma_count", s.gamma_count);
    object.read("learn_slope", s.learn_slope);
}

const char* name(const StaircaseSettings&) {
    return "staircase";
}

void add(ordered_json& object, const StaircaseSettings& s) {
    object["start"] = s.start;
    object["down_after"] = s.down_after;
    object["up_over_down"] = s.up_over_down;
    object["steps"] = s.steps;
    object["averaged_reversals"] = s.averaged_reversals;
    add_posterior(object, s.posterior);
}

void read(JsonObject& object, StaircaseSettings& s) {
    object.read("start", s.start);
    object.read("down_after", s.down_after);
    object.read("up_over_down", s.up_over_down);
    object.read("steps", s.steps);
    object.read("averaged_reversals", s.averaged_reversals);
    read_posterior(object, s.posterior);
}

const char* name(const ConstantStimuliSettings&) {
    return "constant-stimuli";
}

void add(ordered_json& object, const ConstantStimuliSettings& s) {
    object["levels"] = s.levels;
    add_posterior(object, s.posterior);
}

void read(JsonObject& object, ConstantStimuliSettings& s) {
    object.read("levels", s.levels);
    read_posterior(object, s.posterior);
}

const char* name(const LawDirectedSettings&) {
    return "law-directed";
}

/// The values of one field of the shapes, each once, in order.
std::vector<double> values_of(const std::vector<PsychometricShape>& shapes, double PsychometricShape::*field) {
    std::vector<double> values;
    for (const PsychometricShape& shape : shapes) {
        if (std::find(values.begin(), values.end(), shape.*field) == values.end()) values.push_back(shape.*field);
    }
    return values;
}

void add(ordered_json& object, const LawDirectedSettings& s) {
    object["guess_sd"] = s.guess_sd;
    object["deviation_sd"] = s.deviation_sd;
    object["p_threshold"] = s.shapes.front().p_threshold;
    object["gamma"] = s.shapes.front().gamma;
    object["betas"] = values_of(s.shapes, &PsychometricShape::beta);
    object["deltas"] = values_of(s.shapes, &PsychometricShape::delta);
    object["grain"] = s.grain;
    object["range"] = s.range;
    object["longest_lead"] = s.longest_lead;
}

void read(JsonObject& object, LawDirectedSettings& s) {
    object.read("guess_sd", s.guess_sd);
    object.read("deviation_sd", s.deviation_sd);
    PsychometricShape shape = s.shapes.front();
    std::vector<double> betas = values_of(s.shapes, &PsychometricShape::beta);
    std::vector<double> deltas = values_of(s.shapes, &PsychometricShape::delta);
    object.read("p_threshold", shape.p_threshold);
    object.read("gamma", shape.gamma);
    object.read("betas", betas);
    object.read("deltas", deltas);
    for (const auto& [key, list] : {std::pair("betas", &betas), std::pair("deltas", &deltas)}) {
        if (list->empty() || list->size() > 20) object.reject(key, "needs 1 to 20 values", "write for example [3.5]");
    }
    s.shapes.clear();
    for (const double beta : betas) {
        for (const double delta : deltas) s.shapes.push_back({beta, shape.gamma, delta, shape.p_threshold});
    }
    object.read("grain", s.grain);
    object.read("range", s.range);
    object.read("longest_lead", s.longest_lead);
}

/// The settings, all defaults, of the engine that has this name.
template <size_t I = 0>
std::optional<EngineSettings> engine_named(const std::string& text) {
    if constexpr (I == std::variant_size_v<EngineSettings>) {
        return std::nullopt;
    } else {
        const std::variant_alternative_t<I, EngineSettings> settings;
        return text == name(settings) ? EngineSettings(settings) : engine_named<I + 1>(text);
    }
}

template <size_t... I>
std::string engine_names(std::index_sequence<I...>) {
    std::string names;
    ((names += (I > 0 ? ", " : "") + std::string(name(std::variant_alternative_t<I, EngineSettings>{}))), ...);
    return names;
}

}  // namespace

void add_engine(ordered_json& object, const EngineSettings& settings) {
    std::visit(
        [&](const auto& s) {
            object["name"] = name(s);
            add(object, s);
        },
        settings);
}

void read_engine(JsonObject& object, EngineSettings& settings) {
    const std::string names = engine_names(std::make_index_sequence<std::variant_size_v<EngineSettings>>());
    // The engine that is there already keeps its settings.
    std::string asked;
    object.read("name", asked);
    const bool is_there = std::visit([&](const auto& s) { return asked == name(s); }, settings);
    if (!is_there) object.read_named("name", settings, engine_named<>, names.c_str());
    std::visit([&](auto& s) { read(object, s); }, settings);
}

}  // namespace stairstep
