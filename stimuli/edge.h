// The boundary between shadow and light, as a function y = h(x) in the image frame: origin at the image's
// centre, x right, y up, lengths in pixels. Shadow lies below, light on and above the edge.
//
// An edge here never falls: h is non-decreasing. It is either a straight line, or a staircase: what a shadow map leaves of
// a silhouette y = m·x. A texel is dark if its centre lies below the silhouette, so with a texel grid of side a whose
// columns are centred at (k + φx)·a and whose rows meet at (j + φy)·a, the edge has in column k the height
//
//   h_k = a·(⌈m·(k + φx) − φy − ½⌉ + φy)
#pragma once

#include <cmath>
#include <limits>
#include <string_view>

namespace stairstep {

/// A point of the image frame, px.
struct Point {
    double x = 0;
    double y = 0;
};

/// What the edge looks like.
///  step: one step of height a in the middle, as a silhouette of slope a/W leaves after point sampling: m → 0, φ = (½, ½)
///  stair: a silhouette at 45°: m = 1, φ = (0, 0), h(x) = k·a on [(k − ½)a, (k + ½)a)
///  slope: a silhouette of any slope m ≥ 0: the cases between and beyond
///  line: a silhouette that no shadow map has sampled
enum class Pattern { step, stair, slope, line };

std::string_view name(Pattern pattern);

/// Where the texel grid lies under the silhouette, in texels: added to the pattern's own φ.
struct Phase {
    double x = 0;
    double y = 0;

    bool operator==(const Phase&) const = default;
};

class Edge {
  public:
    /// texel_px > 0: side of a shadow-map texel on screen. Throws InputError otherwise, and for a phase or slope that is
    /// not finite, or a slope below 0. A step's phase moves the step: by phase.x texels right, by phase.y texels up.
    static Edge step(double texel_px, Phase phase = {});
    static Edge stair(double texel_px, Phase phase = {});
    static Edge sampled(double slope, double texel_px, Phase phase = {});
    /// y = slope·x; slope ≥ 0 and finite (0 is a horizontal edge).
    static Edge line(double slope);

    Pattern pattern() const { return pattern_; }
    /// m; 0 for a step.
    double slope() const { return slope_; }
    /// a; 0 for a line.
    double texel_px() const { return texel_px_; }

    /// h(x). Half-open to the right: step(a).height(0) is +a/2.
    double height(double x) const;

    /// For staircases: the column that holds x, its height, and its left side (the right side of the one before).
    double column(double x) const;
    double column_height(double column) const;
    double column_begin(double column) const;

    /// A translation of p under which the edge maps onto itself and that brings p near the origin, where coordinates are
    /// most precise: the visibility at p equals that at localised(p).
    Point localised(Point p) const;

  private:
    Edge(Pattern pattern, double texel_px, double slope, Phase phase)
        : pattern_(pattern), texel_px_(texel_px), slope_(slope), phase_(phase) {}

    Pattern pattern_;
    double texel_px_;
    double slope_;
    /// φ, the pattern's own included.
    Phase phase_;
};

// Inline: a picture asks for millions of these.

inline double Edge::column(double x) const {
    // A step has two columns, −1 and 0, that meet where it stands.
    if (pattern_ == Pattern::step) return x < phase_.x * texel_px_ ? -1 : 0;
    return std::floor(x / texel_px_ - phase_.x + 0.5);
}

inline double Edge::column_height(double column) const {
    if (pattern_ == Pattern::step) return ((column < 0 ? -0.5 : 0.5) + phase_.y) * texel_px_;
    return (std::ceil(slope_ * (column + phase_.x) - phase_.y - 0.5) + phase_.y) * texel_px_;
}

inline double Edge::column_begin(double column) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (pattern_ == Pattern::step) return column < 0 ? -kInfinity : column > 0 ? kInfinity : phase_.x * texel_px_;
    return (column + phase_.x - 0.5) * texel_px_;
}

inline double Edge::height(double x) const {
    return pattern_ == Pattern::line ? slope_ * x : column_height(column(x));
}

inline Point Edge::localised(Point p) const {
    if (pattern_ == Pattern::line) return {0, p.y - slope_ * p.x};
    if (pattern_ != Pattern::stair) return p;
    // A stair maps onto itself when it moves by whole texels along its diagonal.
    const double shift = column(p.x) * texel_px_;
    return {p.x - shift, p.y - shift};
}

}  // namespace stairstep
