#include "renderer/bench/frontier.h"

#include <algorithm>
#include <tuple>

namespace stairstep::bench {

bool dominates(const CostAndError& a, const CostAndError& b) {
    return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

std::vector<bool> on_frontier(std::span<const CostAndError> points) {
    std::vector<bool> result(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
        result[i] =
            std::ranges::none_of(points, [&](const CostAndError& other) { return dominates(other, points[i]); });
    }
    return result;
}

std::optional<size_t> dominator_of(std::span<const CostAndError> points, size_t point) {
    std::optional<size_t> best;
    // The least of all that dominate, by error and then cost, is dominated by none itself.
    for (size_t i = 0; i < points.size(); ++i) {
        if (!dominates(points[i], points[point])) continue;
        if (!best || std::tie(points[i].error, points[i].cost) < std::tie(points[*best].error, points[*best].cost))
            best = i;
    }
    return best;
}

}  // namespace stairstep::bench
