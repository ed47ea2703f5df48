#include "renderer/half_plane_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// Texels around what the kernel sees: the occluder's edge may begin and end anywhere in them.
constexpr int kMargin = 16;
/// A centre this near the silhouette counts as on it: m·x of a tie is rounded.
constexpr double kOnSilhouette = 1e-6;

/// y = slope·x + offset, never falling.
struct Line {
    double slope;
    double offset;

    double at(double x) const { return slope * x + offset; }
};

/// What the map covers along an axis, in texels of Edge's grid.
struct Span {
    double first;
    int count;
    std::vector<PlaceInTexel> pixels;
};

/// The texel [j + phase, j + 1 + phase)·a that holds x, by its borders as Edge computes them: pixels may lie on one.
double texel_at(double x, double a, double phase) {
    const double j = std::floor(x / a - phase);
    if (x < (j + phase) * a) return j - 1;
    return x < (j + 1 + phase) * a ? j : j + 1;
}

/// `place(i)` is where pixel i lies, growing, and `texel(i)` the texel that holds it.
template <typename Place, typename Texel>
Span span_of(int pixel_count, double reach, const Place& place, const Texel& texel) {
    const double first = std::floor(place(0) - reach) - kMargin;
    const double last = std::floor(place(pixel_count - 1) + reach) + kMargin;
    if (!(last - first < kLargestHalfPlaneMap)) {
        throw InputError("--source shadow-map",
                         "a map of " + format_number(last - first + 1) + " texels a side would be needed",
                         "use --source exact, larger texels or smaller radii");
    }
    Span span{first, static_cast<int>(last - first) + 1, {}};
    for (int i = 0; i < pixel_count; ++i) {
        const double within = std::clamp(place(i) - texel(i), 0.0, 1.0);
        span.pixels.push_back({static_cast<float>(texel(i) - first), static_cast<float>(within)});
    }
    return span;
}

/// The silhouette in the map's texel space, lowered to the middle between the centres on it or above and those below.
Line edge_between_centres(double slope, const Phase& phase, const Span& x, const Span& y) {
    double gap = 1;
    for (int i = 0; i < x.count; ++i) {
        // Edge::column_height's rows, from the middle of the texels to be compared with.
        const double crossing = slope * (x.first + i + phase.x) - phase.y - 0.5;
        if (crossing < y.first || crossing > y.first + y.count) continue;
        const double below = crossing - (std::ceil(crossing) - 1);
        if (below > kOnSilhouette) gap = std::min(gap, below);
    }
    return {slope, slope * (x.first - 0.5 + phase.x) - phase.y - y.first - gap / 2};
}

/// The point of the vertex grid nearest to the line, among those with an x in [begin, begin + kMargin].
glm::dvec2 grid_point_on(const Line& line, double begin, int vertex_grid) {
    glm::dvec2 best(0);
    double best_distance = 1;
    const double first = std::ceil(begin * vertex_grid);
    for (double x = first; x <= first + kMargin * vertex_grid; ++x) {
        const double y = line.at(x / vertex_grid) * vertex_grid;
        const double distance = std::abs(y - std::round(y));
        if (distance < best_distance) {
            best = {x, std::round(y)};
            best_distance = distance;
        }
    }
    return best / static_cast<double>(vertex_grid);
}

/// Where the line enters and leaves the map, each within the margin and on the vertex grid. The slope is at most 1.
std::pair<glm::dvec2, glm::dvec2> edge_ends(const Line& line, const glm::dvec2& size, int vertex_grid) {
    const double enters = line.slope > 0 ? std::max(0.0, -line.offset / line.slope) : 0;
    const double leaves = line.slope > 0 ? std::min(size.x, (size.y - line.offset) / line.slope) : size.x;
    // A line that misses the map leaves all of it dark or all of it lit.
    if (line.at(0) >= size.y) return {{0, size.y}, {0, size.y}};
    if (line.at(size.x) <= 0) return {{size.x, 0}, {size.x, 0}};
    return {grid_point_on(line, enters, vertex_grid), grid_point_on(line, leaves - kMargin, vertex_grid)};
}

}  // namespace

HalfPlaneMap half_plane_map(const Stimulus& stimulus, int vertex_grid) {
    require_valid(stimulus);
    if (stimulus.pattern == Pattern::line) {
        throw InputError("--source shadow-map", "a line has no texels", "use --source exact");
    }
    const bool step = stimulus.pattern == Pattern::step;
    const Edge stairs = edge_of(stimulus);
    const double a = stimulus.texel_px;
    const Phase own = step ? Phase{0.5, 0.5} : Phase{0, 0};
    const Phase grid{own.x + stimulus.phase.x, own.y + stimulus.phase.y};

    const double reach = support(stimulus.kernel.shape) * stimulus.kernel.radius_px / a;
    if (stimulus.kernel.shape != KernelShape::poisson && !(2 * reach <= kWidestStimulusKernel)) {
        throw InputError("--source shadow-map", "the kernel is " + format_number(2 * reach) + " texels wide",
                         "use --source exact, larger texels or smaller radii");
    }
    const auto column_x = [&](int i) { return pixel_centre(stimulus, i, 0).x; };
    const auto row_y = [&](int i) { return pixel_centre(stimulus, 0, stimulus.height_px - 1 - i).y; };
    const Span x = span_of(
        stimulus.width_px, reach, [&](int i) { return column_x(i) / a - grid.x + 0.5; },
        [&](int i) { return step ? texel_at(column_x(i), a, stimulus.phase.x) : stairs.column(column_x(i)); });
    const Span y = span_of(
        stimulus.height_px, reach, [&](int i) { return row_y(i) / a - grid.y; },
        [&](int i) { return texel_at(row_y(i), a, grid.y); });

    // A step takes its silhouette along wherever its phase moves it.
    double slope = stairs.slope();
    if (step) slope = 0.5 / std::max(std::abs(x.first), std::abs(x.first + x.count));
    const Line edge = edge_between_centres(slope, step ? own : grid, x, y);

    HalfPlaneMap map{x.count, y.count, {}, {}, x.pixels, y.pixels};
    const glm::dvec2 size(map.width, map.height);
    std::pair<glm::dvec2, glm::dvec2> ends;
    if (slope <= 1) {
        ends = edge_ends(edge, size, vertex_grid);
    } else {
        // Seen from the other side of the diagonal it is flat.
        const Line flipped{1 / slope, -edge.offset / slope};
        const auto [first, last] = edge_ends(flipped, {size.y, size.x}, vertex_grid);
        ends = {{first.y, first.x}, {last.y, last.x}};
    }
    // From the map's lower right corner, which sees all of the edge.
    map.occluder = {glm::dvec2(size.x, 0), size, ends.second, ends.first, glm::dvec2(0)};
    const double length = std::hypot(slope, 1);
    map.edge = {-slope / length, 1 / length, -edge.offset / length};
    return map;
}

}  // namespace stairstep
