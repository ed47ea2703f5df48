#include "renderer/texel_quads.h"

#include <gtest/gtest.h>

#include <vector>

#include "renderer/gl/context.h"
#include "renderer/shadow_map.h"
#include "stimuli/random.h"

namespace stairstep {
namespace {

class TexelQuadsTest : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

void write_depths(const DepthMap& map, const std::vector<float>& depths) {
    gl::TextureSubImage2D(map.depth.id(), 0, 0, 0, map.size.x, map.size.y, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    gl::throw_on_error("writing depths");
}

/// All of the texture, row by row from the bottom.
std::vector<glm::vec4> read_quads(const TexelQuads& quads) {
    const glm::ivec2& size = quads.texture_size();
    std::vector<glm::vec4> values(static_cast<size_t>(size.x) * size.y);
    gl::GetTextureImage(quads.texture(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(glm::vec4)),
                        values.data());
    gl::throw_on_error("reading quads");
    return values;
}

TEST_F(TexelQuadsTest, HaveTheHeadersOrder) {
    const DepthMap map = make_depth_map(2, 2);
    write_depths(map, {0.1f, 0.2f, 0.3f, 0.4f});
    TexelQuads quads;
    quads.fill(map.depth.id(), map.size);
    EXPECT_EQ(read_quads(quads)[0], glm::vec4(0.3f, 0.4f, 0.2f, 0.1f));
}

// Corners beside the texture's border are there, what lies beyond the part that is asked for is not looked at, and a small map
// after a large or an oblong one is as if it were the first.
TEST_F(TexelQuadsTest, HoldAllFourDepthsOfEachCorner) {
    const DepthMap map = make_depth_map(140, 131);
    Random random(11);
    TexelQuads quads;
    for (const glm::ivec2& size :
         std::vector<glm::ivec2>{{7, 5}, {140, 131}, {68, 68}, {69, 67}, {5, 131}, {140, 5}, {2, 2}, {3, 2}}) {
        SCOPED_TRACE(testing::Message() << size.x << " × " << size.y);
        std::vector<float> depths(static_cast<size_t>(map.size.x) * map.size.y);
        for (float& depth : depths) depth = static_cast<float>(random.uniform());
        write_depths(map, depths);
        quads.fill(map.depth.id(), size);
        const auto at = [&](int x, int y) { return depths[static_cast<size_t>(y) * map.size.x + x]; };
        const glm::ivec2 count = size - 1;
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(quads.texture_size(), count)));
        const std::vector<glm::vec4> filled = read_quads(quads);
        int wrong = 0;
        for (int j = 0; j < count.y; ++j) {
            for (int i = 0; i < count.x; ++i) {
                const glm::vec4 expected(at(i, j + 1), at(i + 1, j + 1), at(i + 1, j), at(i, j));
                wrong += filled[static_cast<size_t>(j) * quads.texture_size().x + i] != expected;
            }
        }
        EXPECT_EQ(wrong, 0);
    }
}

}  // namespace
}  // namespace stairstep
