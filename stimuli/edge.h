// The boundary between shadow and light, as a function y = h(x) in the image frame: origin at the image's
// centre, x right, y up, lengths in pixels. Shadow lies below, light on and above the edge.
//
// An edge here never falls: h is non-decreasing.
#pragma once

#include <string_view>

namespace stairstep {

/// A point of the image frame, px.
struct Point {
    double x = 0;
    double y = 0;
};

/// What the edge looks like.
///  step: one step of height a in the middle, as a silhouette of slope a/W leaves after point sampling
///  stair: a silhouette at 45°, point-sampled at texel centres: h(x) = k·a on [(k − ½)a, (k + ½)a)
///  line: a silhouette that no shadow map has sampled
enum class Pattern { step, stair, line };

std::string_view name(Pattern pattern);

class Edge {
  public:
    /// texel_px > 0: side of a shadow-map texel on screen. Throws InputError otherwise.
    static Edge step(double texel_px);
    static Edge stair(double texel_px);
    /// y = slope·x; slope ≥ 0 and finite (0 is a horizontal edge).
    static Edge line(double slope);

    Pattern pattern() const { return pattern_; }

    /// h(x). Half-open to the right: step(a).height(0) is +a/2.
    double height(double x) const;

    /// ∫ max(0, level − h(x)) dx over [x0, x1]: the area above the edge and below a level. A sum of terms of
    /// one sign, so nothing cancels; the cost doesn't depend on x1 − x0.
    double area_below(double level, double x0, double x1) const;

    /// A translation of p under which the edge maps onto itself and that brings p near the origin, where
    /// coordinates are most precise: the visibility at p equals that at localised(p).
    Point localised(Point p) const;

  private:
    Edge(Pattern pattern, double texel_px, double slope) : pattern_(pattern), texel_px_(texel_px), slope_(slope) {}

    Pattern pattern_;
    double texel_px_;
    double slope_;
};

}  // namespace stairstep
