// bench.csv: one row a configuration of a scene.
//
// `technique` names the technique with its filter (configuration.h). `resolution` is the side asked for, of auto the longer side
// that the law chose, 0 without a map. `search_taps` and `filter_taps` are lookups a pixel, at most; `lookups` says what each is:
// a tap, or a gather of four texels. Times are medians, ms; `gpu_…` are the driver's. `error_…`, `penumbra_rmse` and shares are of
// visibility at pixel centres against `truth`, which `truth_quality` describes; `rmse_levels` of both as pictures, in levels of
// 255. `wobble`, the mean of those of three motions, is empty where it wasn't measured. `time_ratio` is against the baseline (configuration.h) of the same scene. `light_bleeding` is VisibilityError's. `no_skip` is what was drawn that frames else leave out (shadow_settings.h).
#pragma once

#include <string>
#include <vector>

#include "renderer/bench/measurement.h"

namespace stairstep::bench {

/// What the rows of one scene share.
struct SceneMeasurements {
    std::string scene;
    double radius = 0;
    std::vector<Measurement> measurements;
    Notes notes;
};

/// What all rows share.
struct Setting {
    std::string renderer;
    std::string context;
    int width = 0;
    int height = 0;
    int frames = 0;
    TruthSettings truth;
};

std::string bench_csv(const std::vector<SceneMeasurements>& scenes, const Setting& setting);

/// "fixed" or "auto".
std::string sizing_of(const Configuration& configuration);

}  // namespace stairstep::bench
