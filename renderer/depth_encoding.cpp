#include "renderer/depth_encoding.h"

#include <cassert>

#include "stimuli/error.h"

namespace stairstep {

int bits_of(DepthFormat format) {
    switch (format) {
        case DepthFormat::unorm16: return 16;
        case DepthFormat::unorm24: return 24;
        case DepthFormat::float32: return 32;
    }
    return 32;
}

DepthFormat depth_format_of_bits(int bits) {
    for (const DepthFormat format : {DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::float32}) {
        if (bits_of(format) == bits) return format;
    }
    throw InputError("--depth-bits " + std::to_string(bits), "is no format of depths", "use one of 16, 24, 32");
}

std::string_view name(SpotDepth depth) {
    return depth == SpotDepth::linear ? "linear" : "reciprocal";
}

SpotDepth spot_depth_named(const std::string& name) {
    for (const SpotDepth depth : {SpotDepth::reciprocal, SpotDepth::linear}) {
        if (stairstep::name(depth) == name) return depth;
    }
    throw InputError("--spot-depth", "\"" + name + "\" is nothing that depth is stored in",
                     "use one of reciprocal, linear");
}

double depth_step(DepthFormat format) {
    switch (format) {
        case DepthFormat::unorm16: return 1.0 / 0xffff;
        case DepthFormat::unorm24: return 1.0 / 0xffffff;
        case DepthFormat::float32: return 0;
    }
    return 0;
}

double least_farthest(const DepthEncoding& encoding, double near, double last) {
    if (encoding.spot == SpotDepth::linear) return last;
    // The end is `step` beyond the last: 1 − d(last) = near·(far − last)/(last·(far − near)). Two of them, as either may be
    // stored, and rounding comes on top.
    const double step = 2 * depth_step(encoding.format);
    assert(near > 2 * step * last);
    return last * near * (1 - step) / (near - step * last);
}

}  // namespace stairstep
