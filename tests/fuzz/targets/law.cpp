#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/law/law_file.h"
#include "tests/fuzz/target.h"

namespace stairstep::fuzz {
namespace {

void require_sound(double slope, const Interval& ci95, double contrast) {
    require(std::isfinite(slope) && slope > 0, "a slope is above 0");
    require(ci95.first <= slope && slope <= ci95.second, "a slope lies in its interval");
    require(std::isfinite(ci95.first) && std::isfinite(ci95.second), "an interval is finite");
    require(contrast > 0 && contrast <= 1, "a contrast lies in (0, 1]");
}

}  // namespace

void run_law(std::string_view input) {
    Law law;
    if (!accepted([&] { law = law_from_json(input, "law.json"); })) return;
    require_sound(law.slope, law.slope_ci95, law.contrast);
    require(law.threshold_probability > 0 && law.threshold_probability < 1, "a probability lies in (0, 1)");
    require(law.texel_range_px.first <= law.texel_range_px.second, "a range ascends");
    require(law.observers >= 0 && law.trials >= 0, "counts are 0 or above");
    for (const ConditionLaw& condition : law.conditions) {
        require_sound(condition.slope, condition.slope_ci95, condition.contrast);
        require(std::isfinite(condition.intercept_px) && std::isfinite(condition.exponent), "a form is finite");
    }
    const std::string written = to_json(law).dump();
    require(to_json(law_from_json(written, "again")).dump() == written, "a law reads back as it was written");
}

}  // namespace stairstep::fuzz
