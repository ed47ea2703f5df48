// scaling.csv: one row a technique at a value of an axis.
//
// `technique` names the technique with its filter (bench/configuration.h), `size` is its map's: "auto", the side of a fixed one,
// or "none". `taps` are the filter's, and a search's likewise, 0 where it takes none. Times are medians, ms: `frame_ms` of the
// whole, then its parts; `processor_ms` of the whole by the processor's clock; `gpu_frame_ms` by the driver's clock. `texels` = `width` · `height` of the map as last drawn.
#pragma once

#include <string>
#include <vector>

#include "renderer/scaling/curves.h"

namespace stairstep::scaling {

/// What all rows share.
struct Setting {
    std::string renderer;
    std::string context;
    /// Timed of each technique at each value.
    int frames = 0;
};

std::string scaling_csv(const std::vector<AxisCurves>& axes, const Setting& setting);

/// "auto", "4096" or "none".
std::string size_of(const bench::Configuration& configuration);

}  // namespace stairstep::scaling
