// The truth shows what the rasteriser shows: the same surfaces at the same pixels, lit from the same side.
#include <gtest/gtest.h>

#include "renderer/gl/context.h"
#include "renderer/truth/area_light_truth.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 321;
constexpr int kHeight = 199;

class RasterConvention : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

/// Where the pictures differ, and where the drawn one has an edge: a neighbour of another value.
struct Difference {
    int pixels = 0;
    int pixels_off_edges = 0;
    int edge_pixels = 0;
};

Difference difference_between(const std::vector<float>& truth, const std::vector<float>& drawn) {
    Difference difference;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const float value = drawn[row * kWidth + column];
            bool edge = false;
            for (int y = std::max(0, row - 1); y <= std::min(kHeight - 1, row + 1); ++y) {
                for (int x = std::max(0, column - 1); x <= std::min(kWidth - 1, column + 1); ++x) {
                    edge |= drawn[y * kWidth + x] != value;
                }
            }
            const bool differs = truth[row * kWidth + column] != value;
            difference.pixels += differs;
            difference.pixels_off_edges += differs && !edge;
            difference.edge_pixels += edge;
        }
    }
    return difference;
}

/// Lopsided in every way, so that a picture turned, mirrored or shifted is another one.
Scene lopsided_scene() {
    std::vector<Mesh> meshes = made::box({-1, 0, -0.5f}, {0.2f, 1.3f, 0.7f});
    for (Mesh& side : made::box({0.7f, 0.1f, 0.1f}, {1.5f, 0.6f, 0.9f})) meshes.push_back(std::move(side));
    meshes.push_back(made::ground(0, 3));
    return made::scene_of(meshes);
}

const Direction kLight{-50, 40};
const Camera kCamera = made::camera_at({2.2, 2.9, 3.1}, {35, 30});

// Without shadows visibility is 0 on facets that face away from the light: a silhouette of the camera's own view.
TEST_F(RasterConvention, SurfacesAreSeenAtPixelCentres) {
    Scene scene = lopsided_scene();
    scene.meshes.push_back(made::sphere(0.4f, 24));
    for (Vertex& vertex : scene.meshes.back().vertices) vertex.position += glm::vec3(1.1f, 1.2f, 0.4f);
    for (Mesh& mesh : scene.meshes) mesh.casts = false;
    const ShadowMapShape unused = map_of_size(made::fitted(lopsided_scene(), kLight), 16);
    const std::vector<float> drawn =
        made::draw_visibility(scene, kCamera, "none", {0.1, FilterMode::automatic, 25}, unused, kWidth, kHeight);
    const SceneState state{kCamera, directional_light(kLight, 0.05), {}};
    const Difference difference = difference_between(area_light_visibility(scene, state, kWidth, kHeight, 16), drawn);
    ASSERT_GT(difference.edge_pixels, 500);
    EXPECT_EQ(difference.pixels_off_edges, 0);
    // The rasteriser snaps vertices to 1/256 px; half a pixel's shift would change a good part of them.
    EXPECT_LE(difference.pixels, difference.edge_pixels / 50);
}

TEST_F(RasterConvention, APointsShadowIsThatOfAFineMap) {
    const Scene scene = lopsided_scene();
    const ShadowMapShape shape = map_of_size(made::fitted(scene, kLight), 4096);
    const std::vector<float> drawn =
        made::draw_visibility(scene, kCamera, "hard", {0.01, FilterMode::automatic, 25}, shape, kWidth, kHeight);
    const SceneState state{kCamera, directional_light(kLight, 0), {}};
    const Difference difference = difference_between(area_light_visibility(scene, state, kWidth, kHeight), drawn);
    ASSERT_GT(difference.edge_pixels, 1000);
    EXPECT_EQ(difference.pixels_off_edges, 0);
    // A pixel is some 20 texels wide.
    EXPECT_LE(difference.pixels, difference.edge_pixels / 50);
}

}  // namespace
}  // namespace stairstep
