// The job of `stairstep-render bench`: shadow techniques on equal terms, in scene after scene.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bench/measurement.h"
#include "renderer/bench/wobble.h"
#include "renderer/gl/context.h"

namespace stairstep::bench {

struct BenchJob {
    /// Names of the list of scenes, "truck" for the one of assimp-testmodels, or model files; none twice.
    std::vector<std::string> scenes{"crane", "clutter", "truck", "colonnade", "cornell", "city"};
    /// None twice.
    std::vector<Configuration> configurations = all_configurations();
    /// law_slope is the law's.
    MeasurementSettings measurement;
    TruthSettings truth;
    /// nullopt for none.
    std::optional<WobbleSettings> wobble = WobbleSettings{};
    /// A file, or "kreuzer2017".
    std::string law = "kreuzer2017";
    /// Whether a law of another kernel than the box may be converted by equal variance.
    bool convert_kernel = false;
    /// Half-width of constant filters, world units; by default each scene's own.
    std::optional<double> radius;
    gl::ContextKind context = gl::ContextKind::osmesa;
    /// A folder, made where it isn't there.
    std::filesystem::path out;
};

/// Three scenes within a minute: fewer configurations and frames, cheaper truths, a short look at wobble.
BenchJob quick_job();

/// Does the job: bench.csv, index.html, and for each scene SCENE-frontier.svg and its pictures. Each file is there whole or not at
/// all; bench.csv and the page grow scene by scene. What can't be read or written is found out before anything is drawn. Throws
/// InputError and FailureError. Returns what `--json` prints:
///
///   program, renderer, context, out
///   law        file, kernel, slope_for_box
///   truth      area_light, filter: how good they are, in words
///   scenes     one each: scene, radius, configurations (rows of bench.csv), notes, dominated, and bars: what, met, figures
nlohmann::ordered_json run_bench(const BenchJob& job);

/// The same for people.
std::string summary_of(const nlohmann::ordered_json& result);

}  // namespace stairstep::bench
