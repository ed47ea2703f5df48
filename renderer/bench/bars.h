// The bars that sizing by the law has to clear in a scene.
//
//   time      auto pcf-exact takes at most 0.4 of the frame time of 25 rotated taps over 4096², at a lower penumbra error
//   soft      auto pcss-levels takes at most 0.5 of that of pcss with 25 + 25 taps over 4096², at no higher penumbra error
//             against the area light
//   wobble    auto's shadows wobble no more than those of 4096²: pcf-exact against pcf-rotated, pcss-levels against pcss
#pragma once

#include <string>
#include <vector>

#include "renderer/bench/measurement.h"

namespace stairstep::bench {

inline constexpr double kPcfTimeBar = 0.4;
inline constexpr double kPcssTimeBar = 0.5;

struct Bar {
    std::string what;
    bool met = false;
    /// The figures that decide.
    std::string figures;
};

/// Those that the measurements tell of: four in all, fewer where a configuration or its wobble wasn't measured.
std::vector<Bar> bars_of(const std::vector<Measurement>& measurements);

}  // namespace stairstep::bench
