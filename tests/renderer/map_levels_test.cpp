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

/// Copies unit 2, where the levels are bound, into a texture that can be read.
constexpr std::string_view kCopyVertex = R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }
)";
constexpr std::string_view kCopyFragment = R"(#version 450 core
layout(binding = 2) uniform sampler2D levels;
layout(location = 0) out float copied;
void main() { copied = texelFetch(levels, ivec2(gl_FragCoord.xy), 0).r; }
)";

class FilledLevels : public testing::Test {
  protected:
    std::vector<float> read(const MapLevels& levels, const glm::ivec2& size) {
        const gl::Program program = gl::make_program("copy", {kCopyVertex}, {kCopyFragment});
        const gl::Texture copy = gl::make_texture(GL_R32F, size.x, size.y);
        const gl::Framebuffer framebuffer = gl::make_framebuffer(copy.id(), 0);
        const gl::VertexArray no_vertices = gl::make_vertex_array();
        levels.bind(program);
        gl::BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.id());
        gl::Viewport(0, 0, size.x, size.y);
        gl::UseProgram(program.id());
        gl::BindVertexArray(no_vertices.id());
        gl::DrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<float> values(static_cast<size_t>(size.x) * size.y);
        gl::GetTextureImage(copy.id(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)),
                            values.data());
        gl::throw_on_error("reading levels");
        return values;
    }

    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

// A level's texel holds what the map holds where that texel's centre is: a grid of `factor` texels a side, which lies half a
// texel further along both axes if the factor is even, so that its centres are texel centres.
TEST_F(FilledLevels, HoldTheMapsDepthsAtTheirTexelsCentres) {
    constexpr int kCapacity = 150;
    ShadowMap map = reserve_shadow_map(kCapacity);
    MapLevels levels(true);
    const glm::ivec2 size = levels_texture_size(kCapacity);
    Random random(7);
    // A small map after a large one: what the large one left must not show.
    for (const glm::ivec2& sides : std::vector<glm::ivec2>{{150, 131}, {37, 150}, {64, 64}, {1, 9}, {1, 1}, {5, 2}}) {
        SCOPED_TRACE(testing::Message() << sides.x << " × " << sides.y);
        map.shape.width = sides.x;
        map.shape.height = sides.y;
        // All of the texture, so that only the level's own test keeps out what lies beyond the map.
        std::vector<float> depths(static_cast<size_t>(map.texture_side()) * map.texture_side());
        for (float& depth : depths) depth = static_cast<float>(0.9 * random.uniform());
        gl::TextureSubImage2D(map.memory.depth.id(), 0, 0, 0, map.texture_side(), map.texture_side(),
                              GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
        levels.fill(map);
        ASSERT_EQ(levels.places().size(), level_places(sides.x, sides.y).size());
        const std::vector<float> filled = read(levels, size);
        int wrong = 0;
        int inside = 0;
        for (const LevelPlace& place : levels.places()) {
            const double shift = place.factor % 2 == 0 ? 0.5 : 0;
            for (int j = -kGuardTexels; j < place.height + kGuardTexels; ++j) {
                for (int i = -kGuardTexels; i < place.width + kGuardTexels; ++i) {
                    // Centre of the texel, in the map's texels.
                    const double x = (i + 0.5) * place.factor + shift;
                    const double y = (j + 0.5) * place.factor + shift;
                    float expected = 1;
                    if (x > 0 && y > 0 && x < sides.x && y < sides.y) {
                        ASSERT_EQ(x - std::floor(x), 0.5) << "not a texel's centre";
                        expected = depths[static_cast<size_t>(std::floor(y) + kGuardTexels) * map.texture_side() +
                                          static_cast<size_t>(std::floor(x)) + kGuardTexels];
                        ++inside;
                    }
                    wrong += filled[static_cast<size_t>(place.y + j) * size.x + place.x + i] != expected;
                }
            }
        }
        EXPECT_EQ(wrong, 0);
        EXPECT_GE(inside, sides.x * sides.y);
    }
}

}  // namespace
}  // namespace stairstep
