#include "renderer/surface_choice.h"

#include <cassert>
#include <cmath>

namespace stairstep {
namespace {

// In units of what storing a fragment takes, some 10 ns of a processor. How they were found: docs/skips.md.
/// k: fragments' worth of idle lanes along the edges of a triangle of one fragment.
constexpr double kIdleLanes = 6;
/// r: a pixel's surface is read, and its point found where the pixel's ray meets the plane.
constexpr double kReadingCost = 1.25;
/// t.
constexpr double kTriangleCost = 10;
/// By how much a change must pay: less is the model's error.
constexpr double kWorthChanging = 1.1;

}  // namespace

double drawn_over_stored(const SurfaceCounts& counts, std::span<const double> lighting_costs) {
    assert(!lighting_costs.empty());
    const auto [fragments, pixels, triangles] = counts;
    if (!(fragments > 0)) return 1;
    const double in_blocks = fragments + kIdleLanes * std::sqrt(fragments * triangles);
    double stored = in_blocks;
    double drawn = in_blocks * lighting_costs.front();
    for (const double cost : lighting_costs) stored += pixels * (kReadingCost + cost);
    for (const double cost : lighting_costs.subspan(1)) {
        drawn += pixels / fragments * in_blocks * cost + kTriangleCost * triangles;
    }
    return drawn / stored;
}

SurfaceChoice choose_surfaces(const SurfaceChoice& last, std::span<const double> lighting_costs, bool must) {
    SurfaceChoice next = last;
    if (last.counts) {
        const double ratio = drawn_over_stored(*last.counts, lighting_costs);
        next.storing_pays = last.storing_pays ? ratio * kWorthChanging > 1 : ratio > kWorthChanging;
    }
    next.stored = must || next.storing_pays || !last.counts || last.drawn_frames >= kMostDrawnFrames;
    next.drawn_frames = next.stored ? 0 : last.drawn_frames + 1;
    return next;
}

}  // namespace stairstep
