// Pictures and shadows of solids are the same without their back faces, from outside and from inside.
#include "renderer/back_faces.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/gl/context.h"
#include "stimuli/random.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 64;

/// Outward, closed, and no box: a tetrahedron.
Mesh tetrahedron(const std::array<glm::vec3, 4>& corners) {
    Mesh mesh;
    for (const glm::vec3& corner : corners) mesh.vertices.push_back({corner, {0, 1, 0}, {0, 0}});
    mesh.indices = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
    const double volume =
        glm::dot(corners[1] - corners[0], glm::cross(corners[2] - corners[0], corners[3] - corners[0]));
    if (volume > 0) {
        for (size_t i = 0; i < 12; i += 3) std::swap(mesh.indices[i], mesh.indices[i + 1]);
    }
    return mesh;
}

glm::dvec3 random_point(Random& random, double half_side) {
    const auto place = [&] { return half_side * (2 * random.uniform() - 1); };
    return {place(), place(), place()};
}

Mesh random_tetrahedron(Random& random, const glm::dvec3& middle, double size) {
    std::array<glm::vec3, 4> corners;
    for (glm::vec3& corner : corners) corner = glm::vec3(middle + random_point(random, size));
    return tetrahedron(corners);
}

struct Picture {
    std::vector<uint8_t> colour;
    bool operator==(const Picture&) const = default;
};

Picture draw(const GpuScene& gpu, const SceneState& state, const std::string& technique, Warp warp,
             const Skips& skips) {
    ShadowSettings settings;
    settings.radius = 0.05;
    settings.fixed_size = 64;
    settings.technique.filter = technique == "pcf" ? FilterMode::exact : FilterMode::automatic;
    settings.skips = skips;
    settings.warp = warp;
    const FrameTarget target = make_frame_target(Show::colour, kWidth, kHeight, 1);
    ShadowRenderer renderer(technique_named(technique), settings, gpu, state, static_cast<double>(kWidth) / kHeight);
    gl::PassTimer timer;
    renderer.draw(gpu, state, target, timer);
    return {read_colour(target).pixels};
}

size_t differing(const Picture& a, const Picture& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.colour.size(); i += 3) {
        count += !std::equal(a.colour.begin() + i, a.colour.begin() + i + 3, b.colour.begin() + i);
    }
    return count;
}

SceneState seen_from(const glm::dvec3& eye, const Direction& direction, const Light& light) {
    SceneState state;
    state.camera = made::camera_at(eye, direction);
    state.light = light;
    return state;
}

class BackFaces : public testing::Test {
  protected:
    /// Pixels that differ between all drawn and back faces left out.
    static size_t changed(const GpuScene& gpu, const SceneState& state, const std::string& technique,
                          Warp warp = Warp::none) {
        return differing(draw(gpu, state, technique, warp, {}),
                         draw(gpu, state, technique, warp, skips_without("back-faces")));
    }

    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

// Random solids, turned and moved ones among them, under all kinds of light: seen from all sides, and from within.
TEST_F(BackFaces, AreNotMissed) {
    Random random(7);
    size_t most = 0;
    size_t sum = 0;
    int draws_of_solids = 0;
    constexpr int kRuns = 24;
    for (int run = 0; run < kRuns; ++run) {
        std::vector<Mesh> meshes{made::ground(-1.5f, 6)};
        for (int i = 0; i < 12; ++i) meshes.push_back(random_tetrahedron(random, random_point(random, 1.2), 0.7));
        SceneState state;
        if (run % 2 == 0) {
            for (size_t i = 1; i < meshes.size(); i += 2) meshes[i].mover = 0;
            const glm::dvec3 axis = glm::normalize(random_point(random, 1));
            state.movers = {glm::rotate(glm::translate(glm::dmat4(1), random_point(random, 0.3)), 2.0, axis)};
        }
        const GpuScene gpu = upload(made::scene_of(std::move(meshes)));
        for (const GpuScene::Draw& draw : gpu.draws) draws_of_solids += !draw.solids.empty();
        const Direction view{360 * random.uniform(), 90 * random.uniform()};
        // From far off, and from where solids may hold the eye.
        const double away = run % 3 == 0 ? 0.5 : 4;
        state.camera = made::camera_at(away * basis_towards(view).back, view);
        state.light = directional_light({360 * random.uniform(), 20 + 70 * random.uniform()}, 0.05);
        if (run % 4 == 3) {
            state.light.kind = Light::Kind::spot;
            state.light.position = (run % 8 == 3 ? 0.4 : 4.0) * state.light.basis.back;
            state.light.cone_deg = 60;
        }
        const bool warps = run % 4 == 1;
        const size_t pixels =
            changed(gpu, state, warps || run % 2 == 0 ? "pcf" : "pcss", warps ? Warp::lispsm : Warp::none);
        EXPECT_LE(pixels, 2u) << "run " << run;
        most = std::max(most, pixels);
        sum += pixels;
    }
    EXPECT_EQ(draws_of_solids, 12 * kRuns);
    // At outlines, where front and back meet, roundings decide which is nearer.
    EXPECT_LE(sum, 15u);
}

// Planted: where back faces are what is seen, they are drawn.
TEST_F(BackFaces, AreDrawnWhereTheyAreSeen) {
    const Mesh large = tetrahedron({glm::vec3(-6, -2, -6), {6, -2, -6}, {0, -2, 8}, {0, 9, 0}});
    const Mesh small = tetrahedron({glm::vec3(-0.4, -1, -0.4), {0.4, -1, -0.4}, {0, -1, 0.4}, {0, 0, 0}});
    const GpuScene gpu = upload(made::scene_of({large, small}));
    const Light sun = directional_light({30, 60}, 0.05);
    // From inside the large one; its walls and the small one are seen, and neither is the background.
    const SceneState inside = seen_from({0, 0.5, 2.5}, {0, 10}, sun);
    EXPECT_EQ(changed(gpu, inside, "hard"), 0u);
    const GpuScene nothing = upload(made::scene_of({}));
    const Picture empty = draw(nothing, inside, "hard", Warp::none, {});
    EXPECT_EQ(differing(draw(gpu, inside, "hard", Warp::none, {}), empty), size_t{kWidth} * kHeight);

    // A lamp inside a shade that is closed: without the shade's back faces its light would reach the ground.
    Light lamp = sun;
    lamp.kind = Light::Kind::spot;
    lamp.basis = basis_towards({0, 90});
    lamp.position = {0, -0.7, 0};
    lamp.cone_deg = 60;
    const GpuScene shaded = upload(made::scene_of({made::ground(-2, 5), small}));
    const GpuScene bare = upload(made::scene_of({made::ground(-2, 5)}));
    const SceneState above = seen_from({0, 3, 3}, {0, 45}, lamp);
    EXPECT_EQ(changed(shaded, above, "hard"), 0u);
    EXPECT_GT(differing(draw(shaded, above, "hard", Warp::none, {}), draw(bare, above, "hard", Warp::none, {})), 500u);
}

}  // namespace
}  // namespace stairstep
