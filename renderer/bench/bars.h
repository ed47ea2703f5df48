// The bars that sizing by the law has to clear in a scene.
//
//   time      auto pcf-exact takes at most 0.4 of the frame time of 25 rotated taps over 4096², at a lower penumbra error
//   soft      auto pcss-levels takes at most 0.5 of that of pcss with 25 + 25 taps over 4096², at no higher penumbra error
//             against the area light
//   wobble    auto's shadows wobble no more than those of 4096²: pcf-exact against pcf-rotated, pcss-levels against pcss
//   skips     auto pcf-exact is at least 5 times, auto pcss-levels at least 4 times as fast as the fixed maps where nothing is left out
//   floor     auto pcf-exact takes at most 1.3 of the time of hard shadows from a map of the same size
//   still     a frame in which nothing moved takes no more than without shadows and the lookup of hard ones
#pragma once

#include <string>
#include <vector>

#include "renderer/bench/measurement.h"

namespace stairstep::bench {

inline constexpr double kPcfTimeBar = 0.4;
inline constexpr double kPcssTimeBar = 0.5;
inline constexpr double kPcfSpeedBar = 5;
inline constexpr double kPcssSpeedBar = 4;
inline constexpr double kFloorBar = 1.3;

struct Bar {
    std::string what;
    bool met = false;
    /// The figures that decide.
    std::string figures;
};

/// Those that the measurements tell of: nine in all, fewer where a configuration or its wobble wasn't measured.
std::vector<Bar> bars_of(const std::vector<Measurement>& measurements);

}  // namespace stairstep::bench
