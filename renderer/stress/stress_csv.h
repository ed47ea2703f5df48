// stress.csv: one row a technique under a condition.
//
// `condition` and `value` say what was done, `outcome` is drawn, refused or failed, and `message` says why. `error_rmse`,
// `error_max`, `acne_share`, `detachment_texels`, `drift`, `growth_kib` and `late_growth_kib` are Measurement's (measurement.h), empty where there
// is none to measure.
#pragma once

#include <string>
#include <vector>

#include "renderer/stress/measurement.h"

namespace stairstep::stress {

/// A condition and how each technique fared.
struct ConditionResult {
    Condition condition;
    std::vector<Measurement> measurements;
};

/// What all rows share.
struct Setting {
    std::string renderer;
    std::string context;
    int width = 0;
    int height = 0;
};

/// "drawn", "refused" or "failed".
std::string outcome_of(const Measurement& one);

std::string stress_csv(const std::vector<ConditionResult>& results, const Setting& setting);

}  // namespace stairstep::stress
