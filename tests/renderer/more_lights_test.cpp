// Several lights: each has a shadow of its own, and a picture is what they are together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/gl/context.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 120;
constexpr int kHeight = 90;
constexpr double kAspect = static_cast<double>(kWidth) / kHeight;

Scene boxes_scene() {
    std::vector<Mesh> meshes = made::box({-0.5f, 0, -0.4f}, {0.4f, 1.1f, 0.5f});
    for (Mesh& side : made::box({0.9f, 0.2f, -0.9f}, {1.4f, 0.5f, -0.2f})) meshes.push_back(std::move(side));
    meshes.push_back(made::ground(0, 9));
    return made::scene_of(meshes);
}

/// Suns and spots, each from elsewhere.
std::vector<Light> lights() {
    return {directional_light({40, 35}, 0.05), spot_light({-2, 3, 1}, {0, 0.3, 0}, 0.1, 50),
            directional_light({-70, 60}, 0.02), spot_light({2.5, 4, -1}, {0.5, 0, 0}, 0.2, 40)};
}

SceneState state_under(const std::vector<Light>& lights) {
    SceneState state;
    state.camera = camera_looking_at({1, 3, 4}, {0, 0.3, 0}, 40, 0.5, 40);
    state.light = lights.front();
    state.more_lights.assign(lights.begin() + 1, lights.end());
    return state;
}

ShadowSettings settings_with(const Skips& skips, std::optional<int> fixed_size) {
    ShadowSettings settings;
    settings.radius = 0.06;
    settings.fixed_size = fixed_size;
    settings.largest_size = 2048;
    settings.skips = skips;
    return settings;
}

class MoreLights : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
    std::optional<gl::PassTimer> timer_{std::in_place};
};

// Frames of the same state: what is kept of each light must be that light's.
TEST_F(MoreLights, VisibilityIsTheMeanOfTheLights) {
    const GpuScene gpu = upload(boxes_scene());
    for (const Skips& skips : {Skips{}, skips_without("all"), skips_without("unchanged-pixels")}) {
        for (const char* technique : {"hard", "pcf", "pcss"}) {
            for (const size_t count : {2, 4}) {
                const std::vector<Light> all = lights();
                const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
                const ShadowSettings settings = settings_with(skips, 200);
                std::vector<double> mean(static_cast<size_t>(kWidth) * kHeight, 0);
                for (size_t i = 0; i < count; ++i) {
                    const SceneState alone = state_under({all[i]});
                    ShadowRenderer renderer(technique_named(technique), settings, gpu, alone, kAspect);
                    renderer.draw(gpu, alone, target, *timer_);
                    const std::vector<float> values = read_visibility(target);
                    EXPECT_LT(*std::min_element(values.begin(), values.end()), 0.1f) << "no shadow";
                    for (size_t j = 0; j < mean.size(); ++j) mean[j] += values[j] / count;
                }
                const SceneState together = state_under({all.begin(), all.begin() + count});
                ShadowRenderer renderer(technique_named(technique), settings, gpu, together, kAspect);
                for (int frame = 0; frame < 4; ++frame) {
                    renderer.draw(gpu, together, target, *timer_);
                    const std::vector<float> values = read_visibility(target);
                    double worst = 0;
                    for (size_t j = 0; j < mean.size(); ++j) worst = std::max(worst, std::abs(values[j] - mean[j]));
                    EXPECT_LE(worst, 1e-5) << technique << ", " << count << " lights, frame " << frame;
                }
            }
        }
    }
}

// Each stretch of frames that stand still keeps visibility anew.
TEST_F(MoreLights, WhatIsKeptIsTheLastPlaces) {
    const GpuScene gpu = upload(boxes_scene());
    for (const char* technique : {"pcf", "pcss"}) {
        const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
        const FrameTarget other = make_frame_target(Show::visibility, kWidth, kHeight, 1);
        SceneState state = state_under(lights());
        ShadowRenderer keeping(technique_named(technique), settings_with({}, 200), gpu, state, kAspect);
        ShadowRenderer forgetful(technique_named(technique), settings_with(skips_without("unchanged-pixels"), 200), gpu,
                                 state, kAspect);
        for (int frame = 0; frame < 12; ++frame) {
            state.camera.eye.x = 1 + 0.2 * (frame / 4);
            keeping.draw(gpu, state, target, *timer_);
            forgetful.draw(gpu, state, other, *timer_);
            EXPECT_TRUE(read_visibility(target) == read_visibility(other)) << technique << " frame " << frame;
        }
    }
}

// Each light's map is as large as that light's pixels need, whichever lights were drawn before it.
TEST_F(MoreLights, EachMapIsAsLargeAsItsLightAloneNeeds) {
    const GpuScene gpu = upload(boxes_scene());
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    for (const char* technique : {"pcf", "pcss"}) {
        for (const Skips& skips : {Skips{}, skips_without("all")}) {
            const ShadowSettings settings = settings_with(skips, {});
            const SceneState together = state_under(lights());
            ShadowRenderer renderer(technique_named(technique), settings, gpu, together, kAspect);
            for (int frame = 0; frame < 3; ++frame) renderer.draw(gpu, together, target, *timer_);
            for (size_t i = 0; i < lights().size(); ++i) {
                const SceneState alone = state_under({lights()[i]});
                ShadowRenderer single(technique_named(technique), settings, gpu, alone, kAspect);
                for (int frame = 0; frame < 3; ++frame) single.draw(gpu, alone, target, *timer_);
                EXPECT_EQ(renderer.shadows()[i].map().shape.texel().x, single.map().shape.texel().x)
                    << technique << " light " << i;
            }
        }
    }
}

TEST_F(MoreLights, ALightThatCameAndWentLeavesNothing) {
    const GpuScene gpu = upload(boxes_scene());
    const std::vector<Light> all = lights();
    for (const char* technique : {"pcf", "pcss"}) {
        for (const Show show : {Show::colour, Show::visibility}) {
            const FrameTarget target = make_frame_target(show, kWidth, kHeight, 1);
            const SceneState one = state_under({all[0]});
            ShadowRenderer renderer(technique_named(technique), settings_with({}, 200), gpu, one, kAspect);
            const auto picture = [&](const SceneState& state) {
                renderer.draw(gpu, state, target, *timer_);
                if (show == Show::visibility) return read_visibility(target);
                const Image image = read_colour(target);
                return std::vector<float>(image.pixels.begin(), image.pixels.end());
            };
            const std::vector<float> first = picture(one);
            for (const SceneState& more : {state_under({all[0], all[1]}), state_under({all[0], all[2], all[3]})}) {
                for (int frame = 0; frame < 3; ++frame) EXPECT_NE(picture(more), first);
                EXPECT_EQ(renderer.shadows().size(), 1 + more.more_lights.size());
                for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(picture(one), first) << technique << " " << frame;
                EXPECT_EQ(renderer.shadows().size(), 1u);
            }
        }
    }
}

}  // namespace
}  // namespace stairstep
