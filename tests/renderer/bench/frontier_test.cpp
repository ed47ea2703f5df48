#include "renderer/bench/frontier.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace stairstep::bench {
namespace {

/// Few values, so that equal ones are common.
std::vector<CostAndError> made_points() {
    const auto coordinates = *rc::gen::container<std::vector<std::pair<int, int>>>(
        rc::gen::pair(rc::gen::inRange(0, 12), rc::gen::inRange(0, 12)));
    std::vector<CostAndError> points;
    for (const auto& [cost, error] : coordinates) points.push_back({cost / 4.0, error / 4.0});
    return points;
}

/// By a sweep from the cheapest: the least error at each cost, where it is below that at all lower costs.
std::vector<bool> swept(const std::vector<CostAndError>& points) {
    std::map<double, double> least;
    for (const CostAndError& point : points) {
        const auto [at, is_new] = least.emplace(point.cost, point.error);
        if (!is_new) at->second = std::min(at->second, point.error);
    }
    std::map<double, double> frontier;
    double below = INFINITY;
    for (const auto& [cost, error] : least) {
        if (error < below) frontier[cost] = below = error;
    }
    std::vector<bool> result;
    for (const CostAndError& point : points) {
        const auto at = frontier.find(point.cost);
        result.push_back(at != frontier.end() && at->second == point.error);
    }
    return result;
}

TEST(Frontier, KeepsWhatNothingElseBeats) {
    const std::vector<CostAndError> points{{1, 3}, {2, 2}, {3, 1}, {2, 3}, {3, 3}, {2, 2}};
    EXPECT_EQ(on_frontier(points), (std::vector<bool>{true, true, true, false, false, true}));
    EXPECT_EQ(dominator_of(points, 4), 2u);
    EXPECT_EQ(dominator_of(points, 3), 1u);
    EXPECT_EQ(dominator_of(points, 0), std::nullopt);
    EXPECT_EQ(dominator_of(points, 1), std::nullopt) << "an equal point dominates nothing";
    EXPECT_TRUE(on_frontier({}).empty());
}

RC_GTEST_PROP(Frontier, IsWhatASweepFinds, ()) {
    const std::vector<CostAndError> points = made_points();
    RC_ASSERT(on_frontier(points) == swept(points));
}

RC_GTEST_PROP(Frontier, DominatesAllThatIsNotOnIt, ()) {
    const std::vector<CostAndError> points = made_points();
    const std::vector<bool> best = on_frontier(points);
    for (size_t i = 0; i < points.size(); ++i) {
        const auto dominator = dominator_of(points, i);
        RC_ASSERT(dominator.has_value() == !best[i]);
        if (!dominator) continue;
        RC_ASSERT(best[*dominator]);
        RC_ASSERT(dominates(points[*dominator], points[i]));
        RC_ASSERT(!dominates(points[i], points[*dominator]));
    }
}

RC_GTEST_PROP(Frontier, StaysWhatItIsWithoutTheRest, ()) {
    const std::vector<CostAndError> points = made_points();
    const std::vector<bool> best = on_frontier(points);
    std::vector<CostAndError> kept;
    for (size_t i = 0; i < points.size(); ++i) {
        if (best[i]) kept.push_back(points[i]);
    }
    RC_ASSERT(kept.empty() == points.empty());
    RC_ASSERT(on_frontier(kept) == std::vector<bool>(kept.size(), true));
}

}  // namespace
}  // namespace stairstep::bench
