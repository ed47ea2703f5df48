#include "analysis/law/texel_choice.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stairstep {

double texel_on_ladder(double needed) {
    assert(needed > 0 && std::isfinite(needed));
    int exponent = 0;
    // In [1/2, 1): sixteenths from 8 to 15.
    const double mantissa = std::frexp(needed, &exponent);
    return std::ldexp(std::floor(16 * mantissa), exponent - 4);
}

TexelChoice choose_texel(const TexelChoice& previous, double needed, const TexelPatience& patience) {
    assert(needed > 0);
    if (std::isinf(needed)) return {previous.texel, 0, 0};
    const double wanted = texel_on_ladder(needed);
    if (previous.texel == 0 || wanted < previous.texel) return {wanted, 0, 0};
    if (wanted < previous.texel * patience.dead_band) return {previous.texel, 0, 0};
    const double finest = previous.frames_coarser == 0 ? wanted : std::min(previous.finest_needed, wanted);
    if (previous.frames_coarser + 1 >= patience.frames) return {finest, 0, 0};
    return {previous.texel, previous.frames_coarser + 1, finest};
}

}  // namespace stairstep
