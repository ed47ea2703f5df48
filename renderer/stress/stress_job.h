// The job of `stairstep-render stress`: every technique under every condition.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderer/gl/context.h"
#include "renderer/stress/stress_csv.h"

namespace stairstep::stress {

struct StressJob {
    /// None twice.
    std::vector<std::string> techniques{"hard", "pcf", "pcss", "vsm", "esm"};
    bool quick = false;
    bool long_run = false;
    /// Whether to draw sizes after sizes and frames after frames, too.
    bool courses = true;
    /// Kinds of conditions (Condition::what); all where there are none.
    std::vector<std::string> only;
    MeasurementSettings measurement;
    gl::ContextKind context = gl::ContextKind::osmesa;
    /// A folder, made where it isn't there.
    std::filesystem::path out;
};

/// Does the job: stress.csv, stress.md and index.html, each there whole or not at all. What can't be read or written is found out before
/// anything is drawn. Throws InputError and FailureError. Returns what `--json` prints:
///
///   program, renderer, context, out, broken (rows with NaN, errors of GL or failures)
///   rows    one each: condition, value, technique, outcome, error_rmse, error_max, nan_pixels, gl_errors, acne_share,
///           detachment_texels, drift, growth_kib, late_growth_kib, message; null where there is none to measure
nlohmann::ordered_json run_stress(const StressJob& job);

/// The same for people, a line a condition.
std::string summary_of(const nlohmann::ordered_json& result);

}  // namespace stairstep::stress
