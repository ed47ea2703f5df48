// The stage's truths against what can be said without them: Embree's truth, areas, and places of edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/stress/stage_truth.h"
#include "renderer/truth/area_light_truth.h"

namespace stairstep::stress {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 54;

double rmse(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

// Two ways of tracing, one by Embree in floats through triangles, one through slabs in doubles.
TEST(Stage, IsSeenAndLitAsEmbreeTracesIt) {
    for (const Stage& stage : {plain_stage(), spot_stage()}) {
        const SceneState state = state_of(stage, {});
        const std::vector<float> traced = area_light_visibility(scene_of(stage, 1), state, kWidth, kHeight, 400);
        // 0.0045 root mean square in a penumbra (area_light_truth.h), and no outlier as of a pixel seen elsewhere.
        const std::vector<float> known = true_visibility(stage, TruthOf::area, 0, kWidth, kHeight);
        EXPECT_LT(rmse(known, traced), 0.01);
        int far_off = 0;
        for (size_t i = 0; i < known.size(); ++i) far_off += std::abs(known[i] - traced[i]) > 0.1 ? 1 : 0;
        EXPECT_LE(far_off, 3);
        // All there is to see is in the picture.
        EXPECT_EQ(std::count(known.begin(), known.end(), 0.0f) > 100, true);
        EXPECT_EQ(std::count(known.begin(), known.end(), 1.0f) > 1000, true);
    }
}

// A filter of no width, and a light of no size, are the point.
TEST(Stage, TruthsMeetWhereNothingIsBlurred) {
    Stage stage = plain_stage();
    stage.light.half_side = 0;
    const std::vector<float> point = true_visibility(stage, TruthOf::point, 0, kWidth, kHeight);
    EXPECT_EQ(true_visibility(stage, TruthOf::area, 0, kWidth, kHeight), point);
    EXPECT_EQ(true_visibility(stage, TruthOf::filter, 0, kWidth, kHeight), point);
    EXPECT_EQ(true_visibility(stage, TruthOf::filter, 1e-12, kWidth, kHeight), point);
}

// Under a light at 45° along −x, the shadow of a wide wall of height 1 at x ≤ 0 ends at x = 1; the filter of half-width r
// over the light plane makes of that a ramp as wide as 2r·√2 on the ground: the light plane meets it at 45°.
TEST(Stage, FiltersAnEdgeIntoARamp) {
    Stage stage;
    Bounds wall;
    wall.add({-2, 0, -50});
    wall.add({0, 1, 50});
    stage.boxes = {wall};
    stage.light = directional_light({-90, 45}, 0);
    stage.camera = camera_looking_at({1, 5, 0.001}, {1, 0, 0}, 40, 0.1, 50);
    const double radius = 0.3;
    const std::vector<float> values = true_visibility(stage, TruthOf::filter, radius, kWidth, kHeight);
    int ramp = 0;
    for (int column = 0; column < kWidth; ++column) {
        const auto seen = seen_at(stage, column, kHeight / 2, kWidth, kHeight);
        ASSERT_TRUE(seen);
        if (seen->face != -1 || seen->position.x < 0) continue;
        const double expected = std::clamp(0.5 + (seen->position.x - 1) / (2 * radius * std::numbers::sqrt2), 0.0, 1.0);
        EXPECT_NEAR(values[static_cast<size_t>(kHeight / 2) * kWidth + column], expected, 1.0 / 40 + 1e-6);
        ramp += expected > 0 && expected < 1 ? 1 : 0;
    }
    EXPECT_GT(ramp, 10);
}

TEST(Stage, ClearPixelsKeepTheirDistanceFromShadow) {
    const Stage stage = plain_stage();
    const std::vector<float> values = true_visibility(stage, TruthOf::filter, 0.08, kWidth, kHeight);
    const auto near = clear_pixels(stage, TruthOf::filter, 0.08, 0.01, values, kWidth, kHeight);
    const auto far = clear_pixels(stage, TruthOf::filter, 0.08, 0.2, values, kWidth, kHeight);
    const std::vector<float> wide = true_visibility(stage, TruthOf::filter, 0.25, kWidth, kHeight);
    int fewer = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        EXPECT_TRUE(!near[i] || values[i] == 1);
        EXPECT_TRUE(!far[i] || wide[i] == 1);
        EXPECT_TRUE(near[i] || !far[i]);
        fewer += near[i] && !far[i] ? 1 : 0;
    }
    EXPECT_GT(fewer, 20);
}

}  // namespace
}  // namespace stairstep::stress
