// The job of `stairstep-render scaling`: how the cost of shadow techniques grows with the scene, the picture, the filter and the
// lights.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderer/gl/context.h"
#include "renderer/scaling/axis.h"

namespace stairstep::scaling {

struct ScalingJob {
    /// None twice; values are those measured, `quick_values` aside.
    std::vector<Axis> axes{scaling::axes().begin(), scaling::axes().end()};
    /// None twice; each axis takes those that it bears on.
    std::vector<bench::Configuration> techniques = all_techniques();
    /// What axes start from.
    Scenario scenario;
    /// Timed of each technique at each value, ≥ 1, after those in which its map's size settles.
    int frames = 10;
    /// Most texels a side of the law's maps. No more than the fixed maps have.
    int largest_size = bench::kBaselineSide;
    /// Of shadow maps at once, unless the values of one technique need more.
    double most_map_bytes = 2.0 * 1024 * 1024 * 1024;
    gl::ContextKind context = gl::ContextKind::osmesa;
    /// A folder, made where it isn't there.
    std::filesystem::path out;
};

/// Fewer and smaller values, without hard shadows, 640 × 360 pixels, 3 frames.
ScalingJob quick_job();

/// Does the job: scaling.csv, index.html, and AXIS.svg for each axis; all grow axis by axis, each file whole or not there. Throws
/// InputError and FailureError. Returns what `--json` prints:
///
///   program, renderer, context, out, frames, scenario
///   axes   one each: axis, quantity, and techniques: technique, size, taps, exponent, exponent_se, growth, value, frame_ms,
///          texels (these three a list), and parts: exponent and exponent_se by name, of parts (curves.h) that take time at all values
nlohmann::ordered_json run_scaling(const ScalingJob& job);

/// The same for people.
std::string summary_of(const nlohmann::ordered_json& result);

}  // namespace stairstep::scaling
