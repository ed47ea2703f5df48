// How maps store depth: what a step is, that stored depths are within one, and that pictures are right with all of it.
#include "renderer/depth_encoding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "renderer/gl/context.h"
#include "renderer/shadow_renderer.h"
#include "renderer/stress/measurement.h"
#include "renderer/techniques/techniques.h"
#include "stimuli/error.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr DepthFormat kFormats[]{DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::float32};
constexpr int kWidth = 96;
constexpr int kHeight = 54;
constexpr int kSide = 200;
/// What rounding may cost a depth that is drawn: shaders/receiver.glsl's kRounding.
constexpr double kRounding = 16 * 1.2e-7;

double stored_depth(SpotDepth encoding, double near, double far, double z) {
    return encoding == SpotDepth::linear ? (z - near) / (far - near) : far * (z - near) / (z * (far - near));
}

TEST(DepthEncoding, HasItsAnchorValues) {
    EXPECT_NEAR(depth_step(DepthFormat::unorm16) * 9 * 10, 1.37e-3, 1e-5);
    EXPECT_NEAR(depth_step(DepthFormat::unorm16) * 9, 1.37e-4, 1e-6);
    EXPECT_EQ(depth_step(DepthFormat::float32), 0);
    EXPECT_NEAR(least_farthest({DepthFormat::unorm16, SpotDepth::reciprocal}, 1e-3, 1), 1.031, 1e-3);
    EXPECT_EQ(least_farthest({DepthFormat::float32, SpotDepth::reciprocal}, 1e-3, 1), 1);
    EXPECT_EQ(least_farthest({DepthFormat::unorm16, SpotDepth::linear}, 1e-3, 1), 1);
}

// The last caster is two steps from the far end; the length of a step at either end is the header's.
TEST(DepthEncoding, KeepsTheLastCasterFromTheEnd) {
    for (const DepthFormat format : {DepthFormat::unorm16, DepthFormat::unorm24}) {
        const double step = depth_step(format);
        for (const double near : {1e-3, 0.1, 0.999}) {
            const double far = least_farthest({format, SpotDepth::reciprocal}, near, 1);
            EXPECT_NEAR((1 - stored_depth(SpotDepth::reciprocal, near, far, 1)) / step, 2, 1e-5);
            const double length = step * (far - near) * far / near;
            EXPECT_NEAR(stored_depth(SpotDepth::reciprocal, near, far, far - length), 1 - step,
                        1e-12 + step * 2 * length / far);
        }
    }
}

TEST(DepthEncoding, NamesWhatThereIs) {
    for (const DepthFormat format : kFormats) EXPECT_EQ(depth_format_of_bits(bits_of(format)), format);
    for (const SpotDepth depth : {SpotDepth::reciprocal, SpotDepth::linear}) {
        EXPECT_EQ(spot_depth_named(std::string(name(depth))), depth);
    }
    for (const int bits : {-1, 0, 8, 17, 64}) EXPECT_THROW(depth_format_of_bits(bits), InputError);
    EXPECT_THROW(spot_depth_named("logarithmic"), InputError);
}

class Encoded : public testing::Test {
  protected:
    std::vector<float> picture(const stress::Stage& stage, const std::string& technique,
                               const ShadowSettings& settings) const {
        const GpuScene scene = upload(stress::scene_of(stage, 1));
        const SceneState state = stress::state_of(stage, {});
        const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
        gl::PassTimer timer;
        ShadowRenderer renderer(technique_named(technique), settings, scene, state,
                                static_cast<double>(kWidth) / kHeight);
        renderer.draw(scene, state, target, timer);
        return read_visibility(target);
    }

    static ShadowSettings settings_with(const DepthEncoding& encoding) {
        ShadowSettings settings;
        settings.radius = 0.08;
        settings.depth = encoding;
        return settings;
    }

  private:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

double rmse(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

// A gently sloping plane, whose depth at each texel's centre is known in doubles. What is stored differs by a step at most, and by
// more than rounding: a tolerance without the step would not do.
TEST_F(Encoded, StoredDepthsAreWithinAStep) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.02, 1, -0.03));
    Scene scene =
        made::scene_of({made::polygon({{-2, -0.02f, -2}, {-2, 0.10f, 2}, {2, 0.02f, 2}, {2, -0.10f, -2}}, true),
                        made::polygon({{-0.1f, 2.5f, 0}, {0, 2.5f, 0}, {0, 2.5f, 0.1f}}, true), made::ground(-1, 5)});
    const GpuScene gpu = upload(scene);
    for (const bool spot : {false, true}) {
        SceneState state;
        state.camera = made::camera_at({0, 30, 0.01}, {0, 90}, 1, 100);
        state.light = spot ? spot_light({0, 3, 0.01}, {0, 0, 0}, 0.1, 40) : directional_light({0, 89.9}, 0.02);
        for (const SpotDepth linear : {SpotDepth::reciprocal, SpotDepth::linear}) {
            for (const DepthFormat format : kFormats) {
                SCOPED_TRACE(std::string(spot ? "spot " : "directional ") + std::string(name(linear)) + " " +
                             std::to_string(bits_of(format)));
                const LightFrustum frustum =
                    fit_light_frustum(gpu.extents, state, 1, Fit::axis_aligned, [](const LightFrustum&) { return 0.1; },
                                      Warp::none, {format, linear});
                ShadowMap map = reserve_shadow_map(kSide, format);
                map.shape = map_of_size(frustum, kSide);
                ShadowMapKeeper keeper;
                gl::ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
                keeper.update(gpu, state, map, {false, false});
                std::vector<float> depths(static_cast<size_t>(map.memory.size.x) * map.memory.size.x);
                gl::GetTextureImage(map.memory.depth.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                                    static_cast<GLsizei>(depths.size() * sizeof(float)), depths.data());
                double largest = 0;
                double off_grid = 0;
                const auto& [right, up, back] = frustum.basis;
                for (int row = 20; row < kSide - 20; ++row) {
                    for (int column = 20; column < kSide - 20; ++column) {
                        const glm::dvec2 place = frustum.low + (glm::dvec2(column, row) + 0.5) * map.shape.texel();
                        glm::dvec3 origin = frustum.position;
                        glm::dvec3 way = -back;
                        if (spot) {
                            way += place.x * right + place.y * up;
                        } else {
                            origin += place.x * right + place.y * up;
                        }
                        const double z = -glm::dot(normal, origin) / glm::dot(normal, way);
                        // The small triangle's texels, and its rim.
                        const glm::dvec3 at_small = origin + (2.5 - origin.y) / way.y * way;
                        if (std::abs(at_small.x) < 0.2 && std::abs(at_small.z) < 0.2) continue;
                        const double expected =
                            stored_depth(spot ? linear : SpotDepth::linear, frustum.nearest, frustum.farthest, z);
                        const double stored =
                            depths[static_cast<size_t>(row + kGuardTexels) * map.memory.size.x + column + kGuardTexels];
                        largest = std::max(largest, std::abs(stored - expected));
                        if (format == DepthFormat::unorm16) {
                            off_grid = std::max(off_grid, std::abs(stored * 65535 - std::round(stored * 65535)));
                        }
                    }
                }
                EXPECT_LT(largest, depth_step(format) + kRounding);
                EXPECT_EQ(largest > kRounding, format == DepthFormat::unorm16);
                EXPECT_LT(off_grid, 0.01);
            }
        }
    }
}

// All techniques draw with all formats what they draw with floats, up to what depths a step apart change: softness and moments
// hardly, comparisons where caster and receiver are a step or two apart. The light's range is a few lengths: 16 bits tell 0.1 mm.
TEST_F(Encoded, PicturesAreTheSameInAllFormats) {
    for (const stress::Stage& stage : {stress::plain_stage(), stress::spot_stage()}) {
        for (const char* technique : {"hard", "pcf", "pcss", "vsm", "esm"}) {
            const std::vector<float> floats = picture(stage, technique, settings_with({}));
            for (const DepthFormat format : {DepthFormat::unorm16, DepthFormat::unorm24}) {
                SCOPED_TRACE(std::string(technique) + " " + std::to_string(bits_of(format)));
                EXPECT_LT(rmse(picture(stage, technique, settings_with({format})), floats), 2e-3);
            }
        }
    }
    // Taps, windows that are looked at as one or not, and a warp.
    for (const DepthFormat format : kFormats) {
        ShadowSettings settings = settings_with({format});
        const stress::Stage stage = stress::plain_stage();
        const std::vector<float> whole = picture(stage, "pcf", settings);
        settings.skips = skips_without("even-texels");
        EXPECT_LT(rmse(picture(stage, "pcf", settings), whole), 1e-5);
        settings.technique.filter = FilterMode::regular;
        settings.technique.filter_taps = 400;
        EXPECT_LT(rmse(picture(stage, "pcf", settings), whole), 0.02);
        settings.warp = Warp::lispsm;
        EXPECT_LT(rmse(picture(stage, "pcf", settings), whole), 0.03);
    }
}

TEST_F(Encoded, LinearAndReciprocalAgree) {
    for (const std::string technique : {"hard", "pcf"}) {
        for (const DepthFormat format : kFormats) {
            ShadowSettings settings = settings_with({format, SpotDepth::reciprocal});
            for (const FilterMode filter : {FilterMode::exact, FilterMode::poisson}) {
                settings.technique.filter = filter;
                settings.depth.spot = SpotDepth::reciprocal;
                const std::vector<float> reciprocal = picture(stress::spot_stage(), technique, settings);
                settings.depth.spot = SpotDepth::linear;
                EXPECT_LT(rmse(picture(stress::spot_stage(), technique, settings), reciprocal), 1e-3)
                    << technique << " " << bits_of(format);
            }
        }
    }
    // A directional light's are linear as they are.
    EXPECT_EQ(picture(stress::plain_stage(), "hard", settings_with({DepthFormat::float32, SpotDepth::linear})),
              picture(stress::plain_stage(), "hard", settings_with({})));
}

TEST_F(Encoded, LinearIsRefusedWhereDepthsAreReadAsPlanes) {
    for (const char* technique : {"pcss", "vsm", "esm"}) {
        EXPECT_THROW(picture(stress::spot_stage(), technique, settings_with({DepthFormat::float32, SpotDepth::linear})),
                     InputError);
    }
}

// What a driver that stores depths in 16 bits does to a receiver that takes them for floats: acne. The same map, known for what it
// is, shows none.
TEST_F(Encoded, WithoutTheStepThereIsAcne) {
    stress::Condition condition;
    for (const stress::Condition& one : stress::all_conditions(false, false)) {
        if (one.value == "16 bits, casters over 1e2") condition = one;
    }
    Scene scene = stress::scene_of(condition.stage, 1);
    scene.meshes.insert(scene.meshes.end(), condition.extra.begin(), condition.extra.end());
    const GpuScene gpu = upload(scene);
    const SceneState state = stress::state_of(condition.stage, {});
    const double aspect = static_cast<double>(kWidth) / kHeight;
    ShadowMap map = reserve_shadow_map(2048, DepthFormat::unorm16);
    map.shape = map_of_size(fit_light_frustum(
                                gpu.extents, state, aspect, Fit::axis_aligned, [](const LightFrustum&) { return 0.0; },
                                Warp::none, condition.depth),
                            2048);
    gl::ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    ShadowMapKeeper keeper;
    keeper.update(gpu, state, map, {});
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    SurfacePass surfaces;
    LightingPass lighting("hard");
    const auto technique = technique_named("hard").make({}, map, false);
    const std::vector<float> truth =
        stress::true_visibility(condition.stage, stress::TruthOf::point, 0, kWidth, kHeight);
    const double texel = std::max(map.shape.texel().x, map.shape.texel().y);
    const std::vector<bool> clear =
        stress::clear_pixels(condition.stage, stress::TruthOf::point, 0, 2 * texel, truth, kWidth, kHeight);
    const auto acne = [&](DepthFormat taken_for) {
        map.memory.format = taken_for;
        surfaces.draw(gpu, state, draw_list(gpu, state, {}, Which::all, true), target);
        lighting.light_stored(gpu, state, *technique, map, target, {});
        const std::vector<float> values = read_visibility(target);
        int seen = 0;
        int dark = 0;
        for (int i = 0; i < kWidth * kHeight; ++i) {
            // The ground casts no shadow: none on itself, either.
            if (!clear[i] || stress::seen_at(condition.stage, i % kWidth, i / kWidth, kWidth, kHeight)->face < 0)
                continue;
            ++seen;
            dark += values[i] < 1 ? 1 : 0;
        }
        EXPECT_GT(seen, 50);
        return static_cast<double>(dark) / seen;
    };
    EXPECT_EQ(acne(DepthFormat::unorm16), 0);
    EXPECT_GT(acne(DepthFormat::float32), 0.02);
}

// The deepest caster under a spot that has another one at its lamp: within the last step of 16 bits, its depth would be stored as
// nothing's.
TEST_F(Encoded, TheLastCasterStillCasts) {
    stress::Stage stage;
    Bounds plate;
    plate.add({-0.5, 1, -0.5});
    plate.add({0.5, 1, 0.5});
    Bounds lamp;
    lamp.add({-0.05, 5.5, -0.05});
    lamp.add({0.05, 5.6, 0.05});
    stage.boxes = {plate, lamp};
    stage.light = spot_light({0, 5, 0}, {0.01, 0, 0}, 0.1, 30);
    stage.camera = camera_looking_at({0.1, 0.9, 0.1}, {0, 0, 0}, 20, 0.01, 10);
    for (const DepthFormat format : kFormats) {
        const std::vector<float> values = picture(stage, "hard", settings_with({format}));
        EXPECT_EQ(*std::max_element(values.begin(), values.end()), 0) << bits_of(format);
    }
}

// 16 bits over a range of 10⁴ can't tell a wall of 0.02 from the ground behind it, for as long as that is within a step, rounded
// either way, of the wall's lit face along the light: the gap at its foot is that, and no more.
TEST_F(Encoded, WhatSixteenBitsCostIsAStep) {
    std::map<std::string, double> gaps;
    double range = 0;
    double towards_light = 0;
    for (const stress::Condition& one : stress::all_conditions(false, false)) {
        if (one.what != "depth, directional" || one.extra.empty()) continue;
        towards_light = one.stage.light.basis.back.z;
        if (one.value.ends_with("1e4")) range = 1e4;
        const std::vector<float> truth = stress::true_visibility(one.stage, stress::TruthOf::point, 0, kWidth, kHeight);
        const stress::Measurement measured =
            stress::measure(one, technique_named("hard"), {kWidth, kHeight, 2048}, truth);
        EXPECT_EQ(measured.acne_share, 0) << one.value;
        ASSERT_TRUE(measured.detachment_texels);
        gaps[one.value] = *measured.detachment_texels;
    }
    const double texel = 0.08 / 3.47;
    const auto gap_of = [&](double steps) { return (steps * range / 65535 * towards_light - 0.02) / texel; };
    EXPECT_LT(gaps["16 bits, casters over 1e4"], gap_of(2) + 0.5);
    EXPECT_GT(gaps["16 bits, casters over 1e4"], gap_of(0.5) - 0.5);
    EXPECT_GT(gaps["16 bits, casters over 1e4"], 0.5);
    EXPECT_LT(gaps["24 bits, casters over 1e4"], 0.5);
    EXPECT_LT(gaps["16 bits, casters over 1e2"], 0.5);
}

}  // namespace
}  // namespace stairstep
