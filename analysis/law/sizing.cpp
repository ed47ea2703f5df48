#include "analysis/law/sizing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

void require_positive(double value, const char* subject) {
    if (!(value > 0) || !std::isfinite(value)) {
        throw InputError(std::string(subject) + " " + format_number(value), "must be a finite number above 0",
                         "use for example 0.4");
    }
}

}  // namespace

MapSize shadow_map_size(const SizeRequest& request) {
    require_positive(request.slope, "law slope");
    require_positive(request.radius, "filter radius");
    require_positive(request.extent, "extent");
    if (!(request.smallest_texel >= 0) || !std::isfinite(request.smallest_texel)) {
        throw InputError("smallest texel " + format_number(request.smallest_texel),
                         "must be a finite number, 0 or above", "use 0 for none");
    }
    if (request.largest_size < 1) {
        throw InputError("largest map size " + std::to_string(request.largest_size), "must be at least 1",
                         "use for example 16384");
    }

    const double texel = std::max(request.radius / request.slope, request.smallest_texel);
    MapSize size;
    size.limit = request.smallest_texel > request.radius / request.slope ? SizeLimit::screen : SizeLimit::law;
    // texel may underflow to 0 or the quotient overflow: both end at the largest size.
    const double quotient = request.extent / texel;
    size.texels_wanted =
        std::isfinite(quotient) ? std::max(1.0, std::ceil(quotient * (1 - 1e-12))) : std::numeric_limits<double>::max();
    if (size.texels_wanted > request.largest_size) {
        size.texels = request.largest_size;
        size.limit = SizeLimit::largest_size;
    } else {
        size.texels = static_cast<int>(size.texels_wanted);
    }
    return size;
}

}  // namespace stairstep
