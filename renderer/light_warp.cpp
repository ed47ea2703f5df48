#include "renderer/light_warp.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace stairstep {

LightWarp lispsm_warp(const std::vector<glm::dvec2>& body, const WarpView& view, double margin) {
    assert(!body.empty() && view.near > 0 && view.near <= view.far);
    LightWarp warp;
    warp.curvature = view.sin_angle / (view.near + std::sqrt(view.near * view.far));
    if (view.reach > 0) warp.curvature = std::min(warp.curvature, 0.5 / view.reach);
    warp.middle = view.eye_x;
    double last = -INFINITY;
    warp.first = INFINITY;
    for (const glm::dvec2& corner : body) {
        warp.first = std::min(warp.first, corner.y);
        last = std::max(last, corner.y);
    }
    warp.first -= margin;
    // A half-width in texels, as it is at a filter's middle, is longer beyond it: by q/(1 − q) at most.
    const double q = warp.curvature * view.reach;
    last += margin + view.reach * q / (1 - q);
    warp.length = last - warp.first;

    warp.left = INFINITY;
    warp.right = -INFINITY;
    // A quotient of linear functions is largest, and smallest, at corners.
    for (const glm::dvec2& corner : body) {
        const double x = (corner.x - warp.middle) / (1 + warp.curvature * (corner.y - warp.first));
        warp.left = std::min(warp.left, x);
        warp.right = std::max(warp.right, x);
    }
    const double shear = warp.curvature * std::max(std::abs(warp.left), std::abs(warp.right));
    warp.left -= margin + shear * view.reach;
    warp.right += margin + shear * view.reach;
    return warp;
}

}  // namespace stairstep
