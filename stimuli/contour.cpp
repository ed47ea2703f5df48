#include "stimuli/contour.h"

#include <string>
#include <utility>

#include "stimuli/error.h"

namespace stairstep {
namespace {

constexpr double kPrecision_px = 1e-9;
constexpr double kJumpWidth_px = 1e-3;

/// y_v(x), known to lie in [low, high].
double height_between(const Edge& edge, const Filter& filter, double level, double x, double low, double high) {
    while (high - low > kPrecision_px) {
        const double middle = low + (high - low) / 2;
        if (middle == low || middle == high) break;  // far from the origin numbers are coarser than the precision
        (filter.visibility(edge, {x, middle}) >= level ? high : low) = middle;
    }
    return high;
}

struct Trace {
    const Edge& edge;
    const Filter& filter;
    double level;
    const Window& window;
    double spacing;
    std::vector<Point> points;

    /// Appends what lies between the last point and `end`, and `end`.
    void run_to(Point end) {
        const Point begin = points.back();
        const double width = end.x - begin.x;
        const double rise = end.y - begin.y;
        const bool is_seen = end.y >= window.bottom && begin.y <= window.top;
        if (is_seen && width > kJumpWidth_px && (width > spacing || rise > spacing)) {
            const double x = begin.x + width / 2;
            // The contour never falls, so its ends bracket it; a level piece costs nothing.
            const double y = height_between(edge, filter, level, x, begin.y, end.y);
            run_to({x, y});
            run_to(end);
        } else {
            points.push_back(end);
        }
    }
};

}  // namespace

std::vector<double> contour_levels(int count) {
    if (count < 1 || count > kMostContours) {
        throw InputError("contours " + std::to_string(count), "must be 1 to " + std::to_string(kMostContours),
                         "use for example 5");
    }
    std::vector<double> levels;
    for (int k = 1; k <= count; ++k) levels.push_back(static_cast<double>(k) / (count + 1));
    return levels;
}

double contour_height(const Edge& edge, const Filter& filter, double level, double x_px) {
    const double reach = support(filter.kernel().shape) * filter.kernel().radius_px;
    // One more pixel either side: at the support's very rim rounding may still go either way.
    const double low = edge.height(x_px - reach) - reach - 1;
    const double high = edge.height(x_px + reach) + reach + 1;
    return height_between(edge, filter, level, x_px, low, high);
}

std::vector<Point> contour(const Edge& edge, const Filter& filter, double level, const Window& window,
                           double spacing_px) {
    const auto at = [&](double x) { return Point{x, contour_height(edge, filter, level, x)}; };
    Trace trace{edge, filter, level, window, spacing_px, {at(window.left)}};
    trace.run_to(at(window.right));
    return std::move(trace.points);
}

}  // namespace stairstep
