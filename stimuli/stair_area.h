// A stair under the box, in closed form: the area above the stair and below a level, over a part of the x-axis,
//
//   F(level) = ∫ max(0, level − h(x)) dx over [x₀, x₁],
//
// has cut treads at both ends, and between them an arithmetic series. All terms have one sign, so nothing cancels, and the cost
// depends neither on the length of the part nor on a. The lit area of the box of radius r around (x, y) is
// F(y + r) − F(y − r) over [x − r, x + r].
#pragma once

#include <cmath>

#include "stimuli/edge.h"

namespace stairstep {

/// The treads of a stair over [x₀, x₁]: what F needs to know of the x-axis.
struct StairSpan {
    StairSpan(const Edge& stair, double x0, double x1)
        : first(stair.column(x0)),
          last(stair.column(x1)),
          width(x1 - x0),
          head(stair.column_begin(first + 1) - x0),
          tail(x1 - stair.column_begin(last)) {}

    double first, last;
    /// Lengths: of the whole, and of what it has of the first and the last tread where those are two.
    double width, head, tail;
};

/// What F needs to know of the level: the last tread below it, and how far below that lies, in (0, a].
struct StairLevel {
    StairLevel(const Edge& stair, double level) {
        const double a = stair.texel_px();
        reached = std::ceil((level - stair.column_height(0)) / a) - 1;
        above = level - stair.column_height(reached);
    }

    double reached, above;
};

/// F, for a stair of texel size a.
inline double stair_area(const StairSpan& span, const StairLevel& level, double a) {
    if (level.reached < span.first) return 0;
    const double first_above = level.above + (level.reached - span.first) * a;
    if (span.first == span.last) return span.width * first_above;
    // Where the level ends within the part, its last tread counts whole.
    const bool ends_within = level.reached < span.last;
    const double last = ends_within ? level.reached : span.last;
    if (span.first == last) return span.head * first_above;
    const double last_above = level.above + (level.reached - last) * a;
    const double whole = (last - span.first - 1) * a;
    return span.head * first_above + (ends_within ? a : span.tail) * last_above +
           whole * (first_above + last_above) / 2;
}

}  // namespace stairstep
