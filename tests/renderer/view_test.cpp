#include <gtest/gtest.h>

#include "renderer/view.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

TEST(View, ABasisIsRightHandedAndPerpendicularEverywhere) {
    for (const double azimuth : {-170.0, -50.0, 0.0, 35.0, 90.0}) {
        for (const double elevation : {1.0, 45.0, 90.0}) {
            const Basis basis = basis_towards({azimuth, elevation});
            EXPECT_NEAR(glm::length(glm::cross(basis.right, basis.up) - basis.back), 0, 1e-12);
            EXPECT_NEAR(basis.right.y, 0, 1e-12);
            EXPECT_GE(basis.up.y, -1e-12);
        }
    }
    EXPECT_NEAR(basis_towards({90, 0}).back.x, 1, 1e-12);
    EXPECT_NEAR(basis_towards({0, 90}).back.y, 1, 1e-12);
}

TEST(View, TheCameraFramesAllPointsAndFillsThePicture) {
    Bounds bounds;
    bounds.add({-1, 0, -3});
    bounds.add({2, 2, 4});
    for (const double aspect : {0.5, 16.0 / 9}) {
        for (const double elevation : {5.0, 40.0, 90.0}) {
            const std::vector<glm::dvec3> points = points_of_interest(bounds, {-50, 45});
            const glm::mat4 clip(clip_from_world(framing_camera(points, {30, elevation}, aspect, 1, 10), aspect));
            double widest = 0;
            for (const glm::dvec3& point : points) {
                const glm::vec4 p = clip * glm::vec4(point, 1);
                ASSERT_GT(p.w, 0);
                EXPECT_GT(p.z, 0);
                EXPECT_LT(p.z, p.w);
                widest = std::max<double>({widest, std::abs(p.x / p.w), std::abs(p.y / p.w)});
            }
            EXPECT_NEAR(widest, 0.88, 1e-4) << "the margin";
        }
    }
}

// Pixels and the footprint agree: one footprint sideways is one pixel in the picture.
TEST(View, APixelsFootprintIsAPixel) {
    const Camera camera = made::camera_down({0, 5, 0});
    const double pixel = pixel_footprint(camera, 5, 720);
    const glm::vec4 p = glm::mat4(clip_from_world(camera, 16.0 / 9)) * glm::vec4(glm::vec3(pixel, 0, 0), 1);
    EXPECT_NEAR(p.x / p.w * 1280 / 2, 1, 1e-4);
}

}  // namespace
}  // namespace stairstep
