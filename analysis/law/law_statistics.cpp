#include "analysis/law/law_statistics.h"

#include <nlohmann/json.hpp>

#include "stimuli/number.h"

namespace stairstep {
namespace {

using nlohmann::ordered_json;

ordered_json pair_of(const Interval& interval) {
    return ordered_json::array({interval.first, interval.second});
}

}  // namespace

ordered_json to_json(const SlopeEstimate& estimate) {
    return {{"name", estimate.name},
            {"slope", estimate.value},
            {"slope_ci95", pair_of(estimate.ci95)},
            {"method", estimate.method}};
}

ordered_json to_json(const ObserverSlope& slope) {
    return {{"observer", slope.observer},         {"ln_slope", slope.ln_slope}, {"ln_slope_se", slope.ln_slope_se},
            {"linear_slope", slope.linear_slope}, {"weight", slope.weight},     {"trials", slope.trials}};
}

ordered_json to_json(const LeftOut& left_out, const std::string& key) {
    return {{key, left_out.left_out},
            {"slope", left_out.slope},
            {"change", left_out.change},
            {"largest", left_out.is_largest}};
}

ordered_json to_json(const DownWeighted& weight) {
    ordered_json json{{"observer", weight.observer}};
    if (weight.texel_px) json["texel_px"] = *weight.texel_px;
    json["weight"] = weight.weight;
    return json;
}

ordered_json to_json(const ConditionName& condition) {
    return {{"pattern", name(condition.pattern)}, {"contrast", condition.contrast}, {"kernel", name(condition.kernel)}};
}

ordered_json to_json(const Comparison& comparison) {
    return {{"first", to_json(comparison.first)},
            {"second", to_json(comparison.second)},
            {"ratio", comparison.ratio},
            {"ratio_ci95", pair_of(comparison.ratio_ci95)},
            {"p", comparison.p},
            {"p_holm", comparison.p_holm},
            {"observers", comparison.observers},
            {"method", comparison.method}};
}

ordered_json to_json(const CriterionLaw& criterion) {
    return {{"threshold_probability", criterion.threshold_probability},
            {"slope", criterion.slope},
            {"slope_ci95", pair_of(criterion.slope_ci95)},
            {"worst", to_json(criterion.worst)},
            {"texels_across", criterion.texels_across},
            {"texels_in_all", criterion.texels_in_all}};
}

std::string describe(const ConditionName& condition, bool with_kernel) {
    return std::string(name(condition.pattern)) + " at " + format_number(100 * condition.contrast) + " % contrast" +
           (with_kernel ? ", " + std::string(name(condition.kernel)) : "");
}

}  // namespace stairstep
