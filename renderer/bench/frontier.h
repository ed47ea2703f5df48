// The Pareto frontier of run time against error: what nothing else beats in both.
//
// A point dominates another if it costs no more and errs no more, and is less in one of the two. Equal points don't dominate
// each other.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace stairstep::bench {

struct CostAndError {
    double cost = 0;
    double error = 0;
};

bool dominates(const CostAndError& a, const CostAndError& b);

/// For each point whether none dominates it. Values are finite.
std::vector<bool> on_frontier(std::span<const CostAndError> points);

/// Of those that dominate a point, the frontier's with the least error, and of these the cheapest; nullopt for a point on the
/// frontier.
std::optional<size_t> dominator_of(std::span<const CostAndError> points, size_t point);

}  // namespace stairstep::bench
