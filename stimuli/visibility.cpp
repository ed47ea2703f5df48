#include "stimuli/visibility.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

double box_visibility(const Edge& edge, double radius_px, Point p) {
    p = edge.localised(p);
    const double x0 = p.x - radius_px;
    const double x1 = p.x + radius_px;
    // Wholly lit or wholly dark boxes are the common case and come out exact.
    if (p.y - radius_px >= edge.height(x1)) return 1;
    if (p.y + radius_px <= edge.height(x0)) return 0;
    const double lit = edge.area_below(p.y + radius_px, x0, x1) - edge.area_below(p.y - radius_px, x0, x1);
    return std::clamp(lit / (4 * radius_px * radius_px), 0.0, 1.0);
}

}  // namespace

double visibility(const Edge& edge, const Kernel& kernel, Point p) {
    if (!(kernel.radius_px >= 0) || !std::isfinite(kernel.radius_px)) {
        throw InputError("filter radius " + format_number(kernel.radius_px), "must be a finite number, 0 px or above",
                         "use for example 35");
    }
    if (kernel.shape != KernelShape::box) {
        throw InputError("kernel " + std::string(name(kernel.shape)), "has no exact visibility yet", "use box");
    }
    if (kernel.radius_px == 0) return p.y >= edge.height(p.x) ? 1 : 0;
    return box_visibility(edge, kernel.radius_px, p);
}

}  // namespace stairstep
