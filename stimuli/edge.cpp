#include "stimuli/edge.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

void require_texel(double texel_px) {
    if (!(texel_px > 0) || !std::isfinite(texel_px)) {
        throw InputError("texel size " + format_number(texel_px), "must be a finite number above 0 px",
                         "use for example 10");
    }
}

/// The stair's column that holds x, numbered from the one in the middle.
double column(double x, double texel_px) {
    return std::floor(x / texel_px + 0.5);
}

}  // namespace

std::string_view name(Pattern pattern) {
    switch (pattern) {
        case Pattern::step: return "step";
        case Pattern::stair: return "stair";
        case Pattern::line: return "line";
    }
    return "";
}

Edge Edge::step(double texel_px) {
    require_texel(texel_px);
    return Edge(Pattern::step, texel_px, 0);
}

Edge Edge::stair(double texel_px) {
    require_texel(texel_px);
    return Edge(Pattern::stair, texel_px, 1);
}

Edge Edge::line(double slope) {
    if (!(slope >= 0) || !std::isfinite(slope)) {
        throw InputError("line slope " + format_number(slope), "must be a finite number, 0 or above",
                         "use for example 1");
    }
    return Edge(Pattern::line, 0, slope);
}

double Edge::height(double x) const {
    switch (pattern_) {
        case Pattern::step: return x < 0 ? -texel_px_ / 2 : texel_px_ / 2;
        case Pattern::stair: return column(x, texel_px_) * texel_px_;
        case Pattern::line: return slope_ * x;
    }
    return 0;
}

double Edge::area_below(double level, double x0, double x1) const {
    const auto above = [level](double h) { return std::max(0.0, level - h); };
    switch (pattern_) {
        case Pattern::step: {
            const double left = std::max(0.0, std::min(x1, 0.0) - x0);
            const double right = std::max(0.0, x1 - std::max(x0, 0.0));
            return left * above(-texel_px_ / 2) + right * above(texel_px_ / 2);
        }
        case Pattern::stair: {
            // Treads below the level end at `end`. The first and the last are cut, those between are whole and
            // their heights an arithmetic series.
            const double a = texel_px_;
            const double end = std::min(x1, (std::ceil(level / a) - 0.5) * a);
            if (end <= x0) return 0;
            const double first = column(x0, a);
            const double last = column(end, a);
            if (first == last) return (end - x0) * above(first * a);
            const double head = ((first + 0.5) * a - x0) * above(first * a);
            const double tail = (end - (last - 0.5) * a) * above(last * a);
            const double whole = (last - first - 1) * a * (level - a * (first + last) / 2);
            return head + whole + tail;
        }
        case Pattern::line: {
            const double end = slope_ == 0 || level > slope_ * x1 ? x1 : level / slope_;
            if (end <= x0) return 0;
            return (end - x0) * above(slope_ * (x0 + end) / 2);
        }
    }
    return 0;
}

Point Edge::localised(Point p) const {
    switch (pattern_) {
        case Pattern::step: return p;
        case Pattern::stair: {
            const double shift = column(p.x, texel_px_) * texel_px_;
            return {p.x - shift, p.y - shift};
        }
        case Pattern::line: return {0, p.y - slope_ * p.x};
    }
    return p;
}

}  // namespace stairstep
