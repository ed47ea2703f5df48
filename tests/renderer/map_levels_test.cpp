#include "renderer/map_levels.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>

#include "renderer/gl/context.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

TEST(MapLevels, FactorsDoubleAndTripleInTurn) {
    const std::array expected{1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
    for (size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(level_factor(static_cast<int>(i)), expected[i]);
    EXPECT_EQ(level_factor(kMostLevels - 1), 4096);
    EXPECT_EQ(level_factor(kMostLevels - 2), 3072);
}

struct Block {
    int x0, y0, x1, y1;
};

/// What a level takes up with its guards.
Block taken(const LevelPlace& place) {
    return {place.x - kGuardTexels, place.y - kGuardTexels, place.x + place.width + kGuardTexels,
            place.y + place.height + kGuardTexels};
}

void check_places(int width, int height) {
    const std::vector<LevelPlace> places = level_places(width, height);
    RC_ASSERT(places.size() <= static_cast<size_t>(kMostLevels));
    const glm::ivec2 size = levels_texture_size(std::max(width, height));
    for (size_t i = 0; i < places.size(); ++i) {
        const LevelPlace& place = places[i];
        RC_ASSERT(place.factor == level_factor(static_cast<int>(i)));
        RC_ASSERT(place.width * place.factor >= width && (place.width - 1) * place.factor < width);
        RC_ASSERT(place.height * place.factor >= height && (place.height - 1) * place.factor < height);
        RC_ASSERT((std::max(place.width, place.height) <= 4) == (i + 1 == places.size()));
        const Block a = taken(place);
        RC_ASSERT(a.x0 >= 0 && a.y0 >= 0 && a.x1 <= size.x && a.y1 <= size.y);
        for (size_t j = 0; j < i; ++j) {
            const Block b = taken(places[j]);
            RC_ASSERT(a.x1 <= b.x0 || b.x1 <= a.x0 || a.y1 <= b.y0 || b.y1 <= a.y0);
        }
    }
}

RC_GTEST_PROP(MapLevels, LieApartWithinTheirTexture, ()) {
    const auto side = rc::gen::oneOf(rc::gen::inRange(1, 40), rc::gen::inRange(1, 8193));
    check_places(*side, *side);
}

TEST(MapLevels, TheExtremesLieApartWithinTheirTextureToo) {
    for (const int a : {1, 2, 3, 4, 5, 8191, 8192}) {
        for (const int b : {1, 2, 5, 97, 8192}) {
            check_places(a, b);
            check_places(b, a);
        }
    }
}

/// Of the texture, row by row from the bottom.
std::vector<float> read_depths(const ShadowMap& map) {
    std::vector<float> values(static_cast<size_t>(map.memory.size.x) * map.memory.size.y);
    gl::GetTextureImage(map.memory.depth.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                        static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
    gl::throw_on_error("reading levels");
    return values;
}

void write_depths(const ShadowMap& map, const std::vector<float>& depths) {
    gl::TextureSubImage2D(map.memory.depth.id(), 0, 0, 0, map.memory.size.x, map.memory.size.y, GL_DEPTH_COMPONENT,
                          GL_FLOAT, depths.data());
    gl::throw_on_error("writing depths");
}

class FilledLevels : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

TEST_F(FilledLevels, BeginEmpty) {
    const ShadowMap map = reserve_map_with_levels(100);
    EXPECT_EQ(map.capacity, 100);
    EXPECT_EQ(map.memory.size, levels_texture_size(100));
    for (const float depth : read_depths(map)) ASSERT_EQ(depth, 1);
}

// A level's texel holds what the map holds where that texel's centre is: a grid of `factor` texels a side, which lies half a
// texel further along both axes if the factor is even, so that its centres are texel centres. The map itself and what lies
// between levels stay as they are.
TEST_F(FilledLevels, HoldTheMapsDepthsAtTheirTexelsCentres) {
    ShadowMap map = reserve_map_with_levels(150);
    const glm::ivec2 size = map.memory.size;
    const auto at = [&](int x, int y) { return static_cast<size_t>(y) * size.x + x; };
    MapLevels levels(true);
    Random random(7);
    // A small map after a large one: what the large one left must not show.
    for (const glm::ivec2& sides : std::vector<glm::ivec2>{{150, 131}, {37, 150}, {64, 64}, {1, 9}, {1, 1}, {5, 2}}) {
        SCOPED_TRACE(testing::Message() << sides.x << " × " << sides.y);
        map.shape.width = sides.x;
        map.shape.height = sides.y;
        // All of the texture, so that only the level's own test keeps out what lies beyond the map.
        std::vector<float> expected(static_cast<size_t>(size.x) * size.y);
        for (float& depth : expected) depth = static_cast<float>(0.9 * random.uniform());
        write_depths(map, expected);
        levels.fill(map);
        const std::vector<LevelPlace>& places = levels.places();
        ASSERT_EQ(places.size(), level_places(sides.x, sides.y).size());
        // The map is the first level.
        ASSERT_EQ(places[0].x, kGuardTexels);
        ASSERT_EQ(places[0].y, kGuardTexels);
        for (const LevelPlace& place : places) {
            if (place.factor == 1) continue;
            const double shift = place.factor % 2 == 0 ? 0.5 : 0;
            int inside = 0;
            for (int j = -kGuardTexels; j < place.height + kGuardTexels; ++j) {
                for (int i = -kGuardTexels; i < place.width + kGuardTexels; ++i) {
                    // Centre of the texel, in the map's texels.
                    const double x = (i + 0.5) * place.factor + shift;
                    const double y = (j + 0.5) * place.factor + shift;
                    float& depth = expected[at(place.x + i, place.y + j)];
                    depth = 1;
                    if (x > 0 && y > 0 && x < sides.x && y < sides.y) {
                        ASSERT_EQ(x - std::floor(x), 0.5) << "not a texel's centre";
                        depth = expected[at(static_cast<int>(x) + kGuardTexels, static_cast<int>(y) + kGuardTexels)];
                        ++inside;
                    }
                }
            }
            EXPECT_GE(inside, (place.width - 1) * (place.height - 1));
        }
        const std::vector<float> filled = read_depths(map);
        int wrong = 0;
        for (size_t i = 0; i < filled.size(); ++i) wrong += filled[i] != expected[i];
        EXPECT_EQ(wrong, 0);
    }
}

/// A map of 512 × 512 texels whose level of factor 2 is to hold the numbers from `first` on, row by row, in steps of the
/// format's: most steps by which they are off.
int most_steps_off(DepthFormat format, int first) {
    constexpr int kSide = 256;
    const int bits = bits_of(format);
    ShadowMap map = reserve_map_with_levels(2 * kSide, format);
    map.shape.width = map.shape.height = 2 * kSide;
    const auto at = [&](int x, int y) { return static_cast<size_t>(y) * map.memory.size.x + x; };
    const size_t texels = static_cast<size_t>(map.memory.size.x) * map.memory.size.y;
    // The upper bits are the number itself.
    std::vector<uint32_t> depths(texels, 0xffffffff);
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            const auto number = static_cast<uint32_t>(first + kSide * j + i);
            depths[at(kGuardTexels + 2 * i + 1, kGuardTexels + 2 * j + 1)] =
                number << (32 - bits) | number >> (2 * bits - 32);
        }
    }
    gl::TextureSubImage2D(map.memory.depth.id(), 0, 0, 0, map.memory.size.x, map.memory.size.y, GL_DEPTH_COMPONENT,
                          GL_UNSIGNED_INT, depths.data());
    MapLevels levels(false);
    levels.fill(map);
    std::vector<uint32_t> filled(texels);
    gl::GetTextureImage(map.memory.depth.id(), 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
                        static_cast<GLsizei>(texels * sizeof(uint32_t)), filled.data());
    gl::throw_on_error("reading levels");
    const LevelPlace place = levels.places()[1];
    int most = 0;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            const uint32_t source = filled[at(kGuardTexels + 2 * i + 1, kGuardTexels + 2 * j + 1)] >> (32 - bits);
            // Writing and reading it may have cost a step.
            EXPECT_NEAR(source, first + kSide * j + i, bits == 16 ? 0 : 1);
            const uint32_t copied = filled[at(place.x + i, place.y + j)] >> (32 - bits);
            most = std::max(most, std::abs(static_cast<int>(copied) - static_cast<int>(source)));
        }
    }
    return most;
}

TEST_F(FilledLevels, HoldAllDepthsOf16BitsToTheBit) {
    EXPECT_EQ(most_steps_off(DepthFormat::unorm16, 0), 0);
}

// As floats they pass through the shader, which don't tell all of them apart.
TEST_F(FilledLevels, HoldDepthsOf24BitsToAStep) {
    for (const int first : {0, 0x3f8000, 0x700000, 0x7f8000, 0xbf8000, 0xff0000}) {
        SCOPED_TRACE(first);
        EXPECT_LE(most_steps_off(DepthFormat::unorm24, first), 1);
    }
}

}  // namespace
}  // namespace stairstep
