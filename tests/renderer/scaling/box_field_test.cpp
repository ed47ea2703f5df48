// Boxes in any number of triangles: closed, of the same volume, and the same picture.
#include "renderer/scaling/box_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/bench/measurement.h"
#include "renderer/gl/context.h"
#include "renderer/scaling/axis.h"
#include "renderer/scenes/mesh_shapes.h"
#include "renderer/techniques/techniques.h"
#include "tests/renderer/scenes/mesh_properties.h"

namespace stairstep::scaling {
namespace {

TEST(DividedBox, IsClosedAtAnyFineness) {
    for (const int cells : {1, 2, 3, 7, 10}) {
        Mesh box;
        glm::dmat4 place = turn_about({0, 0, 0}, 23);
        place[3] = glm::dvec4(5.3, 1.7, -2.9, 1);
        append_divided_box(box, {1, 2, 3}, place, cells);
        EXPECT_EQ(box.indices.size(), 3u * 12 * static_cast<size_t>(cells * cells));
        EXPECT_NEAR(volume_of(box), 48, 1e-4) << cells;
        EXPECT_NEAR(area_of(box), 88, 1e-4) << cells;
        EXPECT_TRUE(is_watertight(box)) << cells;
        expect_unit_outward_normals(box);
    }
}

TEST(BoxField, HasTheHeadersTriangles) {
    EXPECT_EQ(triangle_count(make_box_field(1)), 1010u);
    EXPECT_EQ(triangle_count(make_box_field(31)), 968'690u);
    // The nearest by ratio of what there is.
    for (const double wanted : {1.0, 1e3, 2e3, 2.1e3, 1e4, 3e4, 1e6}) {
        const int cells = cells_for(wanted);
        ASSERT_GE(cells, 1);
        const auto off = [&](int n) {
            const double triangles = 1008.0 * n * n + 2;
            return std::max(triangles / wanted, wanted / triangles);
        };
        EXPECT_LE(off(cells), off(cells + 1)) << wanted;
        EXPECT_LE(off(cells), off(std::max(cells - 1, 1))) << wanted;
    }
}

// What makes the axis of triangles one: the picture doesn't know how many there are.
TEST(BoxField, LooksTheSameAtAnyFineness) {
    const auto context = gl::make_osmesa_context();
    Scenario scenario;
    scenario.width = 160;
    scenario.height = 90;
    const SceneState state = state_of(scenario);
    const FrameTarget target = make_frame_target(Show::visibility, scenario.width, scenario.height, 1);
    std::vector<std::vector<float>> pictures;
    for (const int cells : {1, 3, 10}) {
        const GpuScene scene = upload(make_box_field(cells));
        bench::MeasurementSettings settings;
        settings.width = scenario.width;
        settings.height = scenario.height;
        bench::settled_renderer(bench::auto_pcf(), settings, {scene, state, scenario.radius}, target);
        pictures.push_back(read_visibility(target));
    }
    int dark = 0;
    for (const float value : pictures[0]) dark += value < 0.5f;
    EXPECT_GT(dark, 0.1 * scenario.width * scenario.height) << "there are shadows to compare";
    for (size_t i = 1; i < pictures.size(); ++i) {
        int different = 0;
        for (size_t pixel = 0; pixel < pictures[0].size(); ++pixel) {
            different += std::abs(pictures[i][pixel] - pictures[0][pixel]) > 0.02f;
        }
        // Vertices are rounded to floats, so a pixel here and there is just on the other side of an edge.
        EXPECT_LE(different, 0.002 * scenario.width * scenario.height);
    }
}

}  // namespace
}  // namespace stairstep::scaling
