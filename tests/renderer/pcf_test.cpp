// The exact filter against the box over a map whose texels are planted: any width, anywhere, packed or not.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/gl/context.h"
#include "stimuli/random.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr double kLevel = 1 / 255.0;
constexpr float kCasterHeight = 2;

class ExactPcf : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

/// Which texels of a map casters cover, and how many of them lie before each.
class PlantedTexels {
  public:
    PlantedTexels(const ShadowMapShape& shape, Random& random) : shape_(shape) {
        std::vector<int> dark(shape.texel_count());
        for (int i = 0; i < 12; ++i) {
            // Up to a third of the map's sides, over its borders as well.
            const auto interval = [&](int count) {
                const double middle = 1.2 * random.uniform() - 0.1;
                const double half = 0.17 * random.uniform();
                return glm::ivec2(std::floor((middle - half) * count), std::ceil((middle + half) * count));
            };
            const glm::ivec2 x = interval(shape.width);
            const glm::ivec2 y = interval(shape.height);
            rectangles_.push_back({x, y});
            for (int row = std::max(y[0], 0); row < std::min(y[1], shape.height); ++row) {
                for (int column = std::max(x[0], 0); column < std::min(x[1], shape.width); ++column) {
                    dark[static_cast<size_t>(row) * shape.width + column] = 1;
                }
            }
        }
        sums_.resize(static_cast<size_t>(shape.width + 1) * (shape.height + 1));
        for (int row = 0; row < shape.height; ++row) {
            int sum = 0;
            for (int column = 0; column < shape.width; ++column) {
                sum += dark[static_cast<size_t>(row) * shape.width + column];
                sums_[index(column + 1, row + 1)] = sums_[index(column + 1, row)] + sum;
            }
        }
    }

    /// A rectangle for each group of texels, in the plane across the light.
    std::vector<Mesh> casters() const {
        std::vector<Mesh> meshes;
        for (const auto& [x, y] : rectangles_) {
            const glm::vec2 low(shape_.frustum.low + glm::dvec2(x[0], y[0]) * shape_.texel());
            const glm::vec2 high(shape_.frustum.low + glm::dvec2(x[1], y[1]) * shape_.texel());
            meshes.push_back(made::polygon({{low.x, kCasterHeight, -low.y},
                                            {high.x, kCasterHeight, -low.y},
                                            {high.x, kCasterHeight, -high.y},
                                            {low.x, kCasterHeight, -high.y}},
                                           true));
        }
        return meshes;
    }

    /// Lit share of the box around a point of the light plane; there is light beyond the map.
    double visibility(const glm::dvec2& p, double radius) const {
        const glm::dvec2 low = (p - radius - shape_.frustum.low) / shape_.texel();
        const glm::dvec2 high = (p + radius - shape_.frustum.low) / shape_.texel();
        const double dark =
            dark_area(high.x, high.y) - dark_area(low.x, high.y) - dark_area(high.x, low.y) + dark_area(low.x, low.y);
        return 1 - dark / ((high.x - low.x) * (high.y - low.y));
    }

  private:
    size_t index(int x, int y) const { return static_cast<size_t>(y) * (shape_.width + 1) + x; }

    /// In texels, of what lies left of x and below y: linear in each between whole numbers.
    double dark_area(double x, double y) const {
        x = std::clamp<double>(x, 0, shape_.width);
        y = std::clamp<double>(y, 0, shape_.height);
        const int i = std::min(static_cast<int>(x), shape_.width - 1);
        const int j = std::min(static_cast<int>(y), shape_.height - 1);
        const double u = x - i;
        const double v = y - j;
        return (1 - v) * ((1 - u) * sums_[index(i, j)] + u * sums_[index(i + 1, j)]) +
               v * ((1 - u) * sums_[index(i, j + 1)] + u * sums_[index(i + 1, j + 1)]);
    }

    ShadowMapShape shape_;
    std::vector<std::pair<glm::ivec2, glm::ivec2>> rectangles_;
    std::vector<double> sums_;
};

/// A map of this size under a light straight above, over less than what the camera sees of the ground on all four sides.
ShadowMapShape shape_of(const glm::ivec2& size) {
    LightFrustum frustum;
    frustum.basis = basis_towards({0, 90});
    frustum.low = {-0.62, -0.41};
    frustum.high = {0.55, 0.47};
    frustum.nearest = -2.1;
    frustum.farthest = 1;
    return {frustum, size.x, size.y, ShadowMapShape::Limit::fixed};
}

bool is_packed(const made::Filter& filter, const ShadowMapShape& shape) {
    const ShadowMap map{std::max(shape.width, shape.height), {}, shape, filter.radius};
    const auto technique = technique_named("pcf").make(made::settings_of(filter).technique, map, false);
    for (const std::string_view part : technique->shader(map)) {
        if (part.find("sampler2D texel_quads") != std::string_view::npos) return true;
    }
    return false;
}

/// The ground casts too and is at an angle to the light: depths that aren't those of the receiver's plane at each texel show.
void expect_planted_box(double width_texels, const glm::ivec2& size, Random& random) {
    SCOPED_TRACE(testing::Message() << width_texels << " texels wide, map " << size.x << " × " << size.y);
    const ShadowMapShape shape = shape_of(size);
    const PlantedTexels planted(shape, random);
    const glm::vec2 tilt(0.6 * random.uniform() - 0.3, 0.6 * random.uniform() - 0.3);
    const auto on_ground = [&](float x, float z) { return glm::vec3(x, tilt.x * x + tilt.y * z, z); };
    std::vector<Mesh> meshes = planted.casters();
    meshes.push_back(made::polygon({on_ground(-3, -3), on_ground(-3, 3), on_ground(3, 3), on_ground(3, -3)}, true));
    const double radius = 0.5 * width_texels * std::min(shape.texel().x, shape.texel().y);
    const Camera camera = made::camera_down({0, 1.5, 0});
    const std::vector<float> drawn = made::draw_visibility(made::scene_of(meshes), camera, "pcf",
                                                           {radius, FilterMode::exact, 0}, shape, kWidth, kHeight);
    // Rounding moves a box by thousandths of a texel.
    const double tolerance = kLevel + 4e-3 / width_texels;
    int wrong = 0;
    double worst = 0;
    double darkest = 1;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const glm::dvec3 level = made::point_below(camera, column, row, kWidth, kHeight, 0);
            // Along the ray from the camera to where the ground is.
            const double along = camera.eye.y / (camera.eye.y + tilt.x * level.x + tilt.y * level.z);
            const double expected = planted.visibility({along * level.x, -along * level.z}, radius);
            const double error = std::abs(drawn[row * kWidth + column] - expected);
            wrong += error > tolerance;
            worst = std::max(worst, error);
            darkest = std::min(darkest, expected);
        }
    }
    EXPECT_EQ(wrong, 0) << "worst: " << worst;
    EXPECT_LT(darkest, 0.5) << "the picture should show a shadow";
}

TEST_F(ExactPcf, IsTheBoxOverPackedMapsAndOverOthers) {
    Random random(5);
    for (const double widest : {1.0, 2.5, 4.5, 6.94, 8.5, 11.0, 20.0}) {
        const double width = std::max(widest * (0.7 + 0.3 * random.uniform()), 0.5);
        const auto side = [&](int from, int to) { return from + static_cast<int>(random.below(to - from)); };
        const glm::ivec2 small(side(24, 170), side(24, 170));
        const glm::ivec2 large(side(1025, 1100), side(1025, 1100));
        const auto radius = [&](const glm::ivec2& size) {
            const glm::dvec2 texel = shape_of(size).texel();
            return 0.5 * width * std::min(texel.x, texel.y);
        };
        EXPECT_TRUE(is_packed({radius(small), FilterMode::exact, 0}, shape_of(small)));
        EXPECT_FALSE(is_packed({radius(large), FilterMode::exact, 0}, shape_of(large)));
        expect_planted_box(width, small, random);
        expect_planted_box(width, large, random);
    }
}

}  // namespace
}  // namespace stairstep
