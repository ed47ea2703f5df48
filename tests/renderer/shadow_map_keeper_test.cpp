// Maps that are drawn only as far as something changed: how much that is, and that they hold what fresh ones do.
#include "renderer/shadow_map_keeper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "renderer/gl/context.h"
#include "renderer/map_levels.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kSide = 200;
constexpr int kPicture = 64;

class Keeper : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
    std::optional<gl::PassTimer> timer_{std::in_place};
};

/// Two spheres that stand still, far from each other, and a smaller one that moves between them and never sticks out.
Scene spheres_scene() {
    std::vector<Mesh> meshes;
    for (const float x : {-6.0f, 6.0f}) {
        Mesh still = made::sphere(1, 24);
        for (Vertex& vertex : still.vertices) vertex.position += glm::vec3(x, 1, 0);
        meshes.push_back(std::move(still));
    }
    Mesh moving = made::sphere(0.5f, 8);
    moving.mover = 0;
    meshes.push_back(std::move(moving));
    meshes.push_back(made::ground(-0.5f, 20));
    return made::scene_of(meshes);
}

size_t casting_triangles(const Scene& scene, bool moving_alone) {
    size_t count = 0;
    for (const Mesh& mesh : scene.meshes)
        count += mesh.casts && (mesh.mover || !moving_alone) ? mesh.indices.size() / 3 : 0;
    return count;
}

SceneState spheres_state(double x, double azimuth_deg = 30) {
    glm::dmat4 moved(1);
    moved[3] = glm::dvec4(x, 1, 0.1, 1);
    // Sees all.
    return {made::camera_at({0, 30, 0.01}, {0, 90}, 1, 100), directional_light({azimuth_deg, 60}, 0.02), {moved}};
}

ShadowMapShape shape_for(const Scene& scene, const SceneState& state, double reach = 0.1) {
    return map_of_size(
        fit_light_frustum(extents_of(scene), state, 1, Fit::axis_aligned, [&](const LightFrustum&) { return reach; }),
        kSide);
}

std::vector<float> depths(const ShadowMap& map) {
    std::vector<float> values(static_cast<size_t>(map.memory.size.x) * map.memory.size.y);
    gl::GetTextureImage(map.memory.depth.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                        static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
    return values;
}

TEST_F(Keeper, DrawsWhatChangedAndNoMore) {
    const Scene scene = spheres_scene();
    const GpuScene gpu = upload(scene);
    ShadowMapKeeper keeper;
    ShadowMapKeeper forgetful;
    const size_t all = casting_triangles(scene, false);
    const size_t moving = casting_triangles(scene, true);
    ASSERT_LT(moving, all / 4);
    ShadowMap map;
    ShadowMap fresh;
    const auto drawn = [&](const SceneState& state) {
        map.shape = fresh.shape = shape_for(scene, state);
        const bool drew = keeper.update(gpu, state, map, {true, true});
        EXPECT_EQ(drew, keeper.triangles() > 0);
        EXPECT_TRUE(forgetful.update(gpu, state, fresh, {false, false}));
        EXPECT_EQ(forgetful.triangles(), all);
        EXPECT_EQ(depths(map), depths(fresh)) << "what is kept is what would be drawn";
        return keeper.triangles();
    };
    // One after the other: what was put aside in one format is of no use in the next. Beside the map all stays empty.
    const std::array reserves{+[](DepthFormat format) { return reserve_shadow_map(kSide, format); },
                              +[](DepthFormat format) { return reserve_map_with_levels(kSide, format); }};
    for (int kind = 0; kind < 6; ++kind) {
        const DepthFormat format =
            std::array{DepthFormat::float32, DepthFormat::unorm16, DepthFormat::unorm24}[kind / 2];
        SCOPED_TRACE(testing::Message() << bits_of(format) << " bits" << (kind % 2 == 1 ? ", with levels" : ""));
        map = reserves[kind % 2](format);
        fresh = reserves[kind % 2](format);
        EXPECT_EQ(drawn(spheres_state(0)), all);
        for (int i = 0; i < 3; ++i) EXPECT_EQ(drawn(spheres_state(0)), 0u);
        EXPECT_EQ(drawn(spheres_state(0.5)), all) << "those that stand still are put aside, once";
        for (int i = 0; i < 3; ++i) EXPECT_EQ(drawn(spheres_state(1 + 0.5 * i)), moving);
        EXPECT_EQ(drawn(spheres_state(2)), 0u);
        EXPECT_EQ(drawn(spheres_state(2, 50)), all) << "the light moved";
        EXPECT_EQ(drawn(spheres_state(2, 50)), 0u);
        EXPECT_EQ(drawn(spheres_state(2.5, 70)), all) << "both moved";
        EXPECT_EQ(drawn(spheres_state(3, 70)), all);
        EXPECT_EQ(drawn(spheres_state(-3, 70)), moving);
    }
}

TEST_F(Keeper, RedrawsForAnotherSceneAndOtherMemory) {
    const Scene scene = spheres_scene();
    const GpuScene gpu = upload(scene);
    const GpuScene same = upload(scene);
    const SceneState state = spheres_state(0);
    ShadowMapKeeper keeper;
    ShadowMap map = reserve_shadow_map(kSide);
    ShadowMap other = reserve_shadow_map(kSide);
    map.shape = other.shape = shape_for(scene, state);
    const auto drawn = [&](const GpuScene& of, const ShadowMap& into) {
        keeper.update(of, state, into, {});
        return keeper.triangles();
    };
    const size_t all = casting_triangles(scene, false);
    EXPECT_EQ(drawn(gpu, map), all);
    EXPECT_EQ(drawn(same, map), all);
    EXPECT_EQ(drawn(same, map), 0u);
    EXPECT_EQ(drawn(same, other), all);
    EXPECT_EQ(depths(map), depths(other));
    EXPECT_EQ(drawn(same, map), casting_triangles(scene, true)) << "those that stand still were put aside";
    EXPECT_EQ(depths(map), depths(other));
    // Smaller, in the same memory.
    map.shape = map_of_size(map.shape.frustum, kSide / 2);
    EXPECT_EQ(drawn(same, map), all);
    EXPECT_EQ(drawn(same, map), 0u);
}

// A picture of one sphere's surroundings: the other sphere's map isn't needed, and drawing it wouldn't show.
TEST_F(Keeper, LeavesOutCastersThatShadeNothingVisible) {
    const Scene scene = spheres_scene();
    const GpuScene gpu = upload(scene);
    const FrameTarget target = make_frame_target(Show::visibility, kPicture, kPicture, 1);
    SceneState state = spheres_state(0);
    state.camera = made::camera_at({-6, 6, 0.01}, {0, 90}, 1, 100);
    ShadowSettings settings;
    settings.radius = 0.1;
    const auto draw = [&](const Skips& skips, size_t& triangles) {
        settings.skips = skips;
        ShadowRenderer renderer(technique_named("pcf"), settings, gpu, state, 1);
        renderer.draw(gpu, state, target, *timer_);
        triangles = renderer.shadows().front().caster_triangles();
        return read_visibility(target);
    };
    size_t culled = 0;
    size_t all = 0;
    const std::vector<float> with = draw({}, culled);
    const std::vector<float> without = draw(skips_without("unseen-triangles"), all);
    EXPECT_EQ(with, without);
    EXPECT_LT(*std::min_element(with.begin(), with.end()), 0.1f) << "a shadow is to be seen";
    EXPECT_EQ(all, casting_triangles(scene, false));
    EXPECT_LT(culled, all * 0.6);
    EXPECT_GE(culled, all * 0.3);
}

TEST_F(Keeper, FramesThatStandStillDrawNoDepth) {
    const Scene scene = spheres_scene();
    const GpuScene gpu = upload(scene);
    const FrameTarget target = make_frame_target(Show::visibility, kPicture, kPicture, 1);
    for (const char* technique : {"hard", "pcf", "pcss", "vsm", "esm"}) {
        ShadowSettings settings;
        settings.radius = 0.1;
        settings.fixed_size = kSide;
        ShadowRenderer renderer(technique_named(technique), settings, gpu, spheres_state(0), 1);
        const auto drawn = [&](double x, double azimuth_deg = 30) {
            renderer.draw(gpu, spheres_state(x, azimuth_deg), target, *timer_);
            return renderer.shadows().front().caster_triangles();
        };
        const size_t all = drawn(0);
        EXPECT_EQ(all, casting_triangles(scene, false));
        EXPECT_EQ(drawn(0), 0u) << technique;
        drawn(0.5);
        EXPECT_EQ(drawn(1), casting_triangles(scene, true)) << technique;
        EXPECT_EQ(drawn(1, 40), all) << technique;
    }
}

}  // namespace
}  // namespace stairstep
