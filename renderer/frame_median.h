// The middle of what was measured over frames.
#pragma once

#include <algorithm>
#include <cassert>
#include <iterator>
#include <vector>

#include "renderer/shadow_renderer.h"

namespace stairstep {

/// The mean of the two in the middle where their number is even; of one value or more.
inline double median(std::vector<double> values) {
    assert(!values.empty());
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// The median of measure(time) over frames.
template <typename Measure>
double median_of(const std::vector<FrameTime>& times, Measure measure) {
    std::vector<double> values;
    std::transform(times.begin(), times.end(), std::back_inserter(values), measure);
    return median(std::move(values));
}

}  // namespace stairstep
