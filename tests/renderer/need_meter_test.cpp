#include "renderer/need_meter.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/gl/context.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

using Kind = NeedStatistic::Kind;
constexpr float kNone = 1e30f;

TEST(NeededTexel, TakesItsStatistic) {
    // Tiles 1 … 20; the pixels' needs are ten times those, in another order.
    TileNeeds tiles;
    for (int i = 0; i < 20; ++i) {
        tiles.finest.push_back(static_cast<float>(1 + (7 * i) % 20));
        tiles.one_pixel.push_back(static_cast<float>(10 * (1 + (3 * i) % 20)));
    }
    EXPECT_EQ(needed_texel(tiles, {Kind::extreme, 0.5}), 1);
    EXPECT_EQ(needed_texel(tiles, {Kind::tiles, 0}), 1);
    EXPECT_EQ(needed_texel(tiles, {Kind::tiles, 0.05}), 2);
    EXPECT_EQ(needed_texel(tiles, {Kind::tiles, 0.99}), 20);
    EXPECT_EQ(needed_texel(tiles, {Kind::percentile, 0}), 10);
    EXPECT_EQ(needed_texel(tiles, {Kind::percentile, 0.05}), 20);
    EXPECT_EQ(needed_texel(tiles, {Kind::percentile, 0.5}), 110);
}

TEST(NeededTexel, LeavesOutPixelsWithoutNeed) {
    const TileNeeds tiles{{3, 4, 5}, {kNone, 9, kNone}};
    EXPECT_EQ(needed_texel(tiles, {Kind::percentile, 0.05}), 9);
    EXPECT_EQ(needed_texel(tiles, {Kind::extreme, 0.05}), 3);
}

TEST(NeededTexel, IsInfiniteWhereNothingNeedsAny) {
    const TileNeeds none{{kNone, kNone, INFINITY}, {kNone, INFINITY, NAN}};
    for (const Kind kind : {Kind::extreme, Kind::percentile, Kind::tiles}) {
        EXPECT_EQ(needed_texel({}, {kind, 0.05}), INFINITY);
        EXPECT_EQ(needed_texel(none, {kind, 0.05}), INFINITY);
    }
}

// Ties and all: at most the share lies below the statistic, and more than the share lies at or below it.
RC_GTEST_PROP(NeededTexel, LeavesOutNoMoreThanItsShare, ()) {
    const auto values = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 12)));
    const double share = *rc::gen::inRange(0, 100) / 100.0;
    const TileNeeds tiles{{values.begin(), values.end()}, {values.rbegin(), values.rend()}};
    for (const Kind kind : {Kind::percentile, Kind::tiles}) {
        const double needed = needed_texel(tiles, {kind, share});
        const auto below = std::count_if(values.begin(), values.end(), [&](int v) { return v < needed; });
        const auto up_to = std::count_if(values.begin(), values.end(), [&](int v) { return v <= needed; });
        RC_ASSERT(static_cast<double>(below) <= share * static_cast<double>(values.size()) + 1e-9);
        RC_ASSERT(static_cast<double>(up_to) > share * static_cast<double>(values.size()) - 1e-9);
    }
}

class Meter : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

void fill_need(const FrameTarget& target, const std::vector<float>& needs) {
    gl::TextureSubImage2D(target.need.id(), 0, 0, 0, target.width, target.height, GL_RED, GL_FLOAT, needs.data());
}

TEST_F(Meter, ReturnsEachTilesFinestNeedAndOneOfItsPixels) {
    NeedMeter meter;
    EXPECT_FALSE(meter.take().has_value());
    Random random(3);
    for (const glm::ivec2& size : std::vector<glm::ivec2>{{1, 1}, {8, 8}, {9, 7}, {33, 50}, {320, 181}}) {
        SCOPED_TRACE(testing::Message() << size.x << " × " << size.y);
        const FrameTarget target = make_frame_target(Show::visibility, size.x, size.y, 1);
        std::vector<float> needs(static_cast<size_t>(size.x) * size.y);
        std::map<std::pair<int, int>, std::vector<float>> tiles;
        const bool blank = size.x > 8;
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                float& need = needs[static_cast<size_t>(y) * size.x + x];
                // Some tiles need nothing at all, the others' pixels often nothing.
                const bool needs_none = (blank && (x / 8 + y / 8) % 3 == 0) || (blank && random.uniform() < 0.5);
                need = needs_none ? kNone : static_cast<float>(1e-3 + random.uniform());
                tiles[{y / 8, x / 8}].push_back(need);
            }
        }
        fill_need(target, needs);
        meter.measure(target);
        const std::optional<TileNeeds> taken = meter.take();
        ASSERT_TRUE(taken.has_value());
        EXPECT_FALSE(meter.take().has_value()) << "a frame's needs count once";
        std::vector<float> finest;
        size_t i = 0;
        for (const auto& [place, values] : tiles) {
            const float least = *std::min_element(values.begin(), values.end());
            if (least >= kNone) continue;
            finest.push_back(least);
            ASSERT_LT(i, taken->one_pixel.size());
            EXPECT_NE(std::find(values.begin(), values.end(), taken->one_pixel[i++]), values.end());
        }
        EXPECT_EQ(taken->finest, finest);
        EXPECT_EQ(taken->one_pixel.size(), finest.size());
    }
}

TEST_F(Meter, AFrameThatNeedsNothingHasNoTiles) {
    NeedMeter meter;
    const FrameTarget target = make_frame_target(Show::visibility, 40, 30, 1);
    fill_need(target, std::vector<float>(40 * 30, kNone));
    meter.measure(target);
    const std::optional<TileNeeds> taken = meter.take();
    ASSERT_TRUE(taken.has_value());
    EXPECT_TRUE(taken->finest.empty());
    EXPECT_TRUE(taken->one_pixel.empty());
}

// The one pixel is a fair choice of the tile's: over many tiles each place has its turn.
TEST_F(Meter, OnePixelStandsForAllPlacesInATile) {
    NeedMeter meter;
    constexpr int kSide = 512;
    const FrameTarget target = make_frame_target(Show::visibility, kSide, kSide, 1);
    std::vector<float> needs;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) needs.push_back(static_cast<float>(1 + x % 8 + 8 * (y % 8)));
    }
    fill_need(target, needs);
    meter.measure(target);
    std::map<float, int> turns;
    const std::optional<TileNeeds> taken = meter.take();
    for (const float place : taken.value().one_pixel) ++turns[place];
    EXPECT_GE(turns.size(), 32u);
    for (const auto& [place, count] : turns) EXPECT_LE(count, 4 * kSide * kSide / 64 / 64) << place;
}

}  // namespace
}  // namespace stairstep
