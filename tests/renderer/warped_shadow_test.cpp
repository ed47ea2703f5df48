// Shadows through a warped map: the same as through a plain one, with finer steps near the camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/gl/context.h"
#include "stimuli/error.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kAspect = static_cast<double>(kWidth) / kHeight;
constexpr double kLevel = 1 / 255.0;

class WarpedShadow : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

/// Along −z over a ground at y = 0, under casters at y = 2, the light straight above or slanting.
SceneState view_along(const Direction& light) {
    SceneState state;
    state.camera = camera_looking_at({0, 1.2, 0}, {0, 0.4, -5}, 45, 0.5, 60);
    state.light = directional_light(light, 0);
    return state;
}

struct Drawn {
    std::vector<float> visibility;
    ShadowMapShape shape;
};

Drawn draw(const Scene& scene, const SceneState& state, const std::string& technique, ShadowSettings settings,
           std::optional<int> side, Warp warp) {
    const GpuScene gpu = upload(scene);
    settings.fixed_size = side;
    settings.warp = warp;
    ShadowRenderer renderer(technique_named(technique), settings, gpu, state, kAspect);
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    gl::PassTimer timer;
    renderer.draw(gpu, state, target, timer);
    return {read_visibility(target), renderer.map().shape};
}

/// Where a pixel's ray meets the ground, and whether it does within 45 units.
std::optional<glm::dvec3> ground_point(const Camera& camera, int column, int row) {
    const double pixel = pixel_footprint(camera, 1, kHeight);
    const glm::dvec3 ray = -camera.basis.back + (column + 0.5 - kWidth / 2.0) * pixel * camera.basis.right -
                           (row + 0.5 - kHeight / 2.0) * pixel * camera.basis.up;
    if (ray.y >= 0) return std::nullopt;
    const double along = -camera.eye.y / ray.y;
    return along < 45 ? std::optional(camera.eye + along * ray) : std::nullopt;
}

/// w at a point.
double w_at(const LightFrustum& frustum, const glm::dvec3& point) {
    return 1 + frustum.warp.curvature * (light_plane_point(frustum, point).y - frustum.warp.first);
}

/// Bands across the view, dark where z is in [−2j − 1, −2j), whose shadows are bands.
Scene bands() {
    std::vector<Mesh> meshes{made::ground(0, 60)};
    for (int i = 0; i < 25; ++i) {
        const float z = static_cast<float>(-2 * i);
        meshes.push_back(made::polygon({{-60, 2, z - 1}, {-60, 2, z}, {60, 2, z}, {60, 2, z - 1}}, true));
    }
    return made::scene_of(meshes);
}

/// The box of half-width r over bands whose shadows lie right below.
double light_through_bands(double z, double r) {
    // Light up to z, of which each band takes 1 of 2.
    const auto light = [](double at) {
        const double pair = std::floor(at / 2);
        return pair + std::min(at - 2 * pair, 1.0);
    };
    return (light(z + r) - light(z - r)) / (2 * r);
}

// At any distance the filter is as wide in the world.
TEST_F(WarpedShadow, PenumbrasAreOfOneWidthNearAndFar) {
    const Scene across = bands();
    const Scene along = made::scene_of(
        {made::polygon({{-60, 2, -60}, {-60, 2, 1}, {0, 2, 1}, {0, 2, -60}}, true), made::ground(0, 60)});
    const SceneState state = view_along({0, 90});
    for (const bool is_across : {true, false}) {
        for (const double radius : {0.2, 0.4}) {
            SCOPED_TRACE(testing::Message() << (is_across ? "across " : "along ") << radius);
            const Drawn drawn = draw(is_across ? across : along, state, "pcf",
                                     made::settings_of({radius, FilterMode::exact, 0}), 512, Warp::lispsm);
            const LightFrustum& frustum = drawn.shape.frustum;
            ASSERT_TRUE(frustum.warp.warps());
            ASSERT_GT(frustum.warp.texel_ratio().y, 10);
            int checked_near = 0;
            int checked_far = 0;
            for (int row = 0; row < kHeight; ++row) {
                for (int column = 0; column < kWidth; ++column) {
                    const auto point = ground_point(state.camera, column, row);
                    if (!point || point->z < -38 || std::abs(point->x) > 3) continue;
                    const double expected = is_across ? light_through_bands(point->z, radius)
                                                      : std::clamp(0.5 + point->x / (2 * radius), 0.0, 1.0);
                    // Half a texel for each of a penumbra's edges, and w's change within the filter.
                    const double w = w_at(frustum, *point);
                    const glm::dvec2 texel = drawn.shape.smallest_texel() * glm::dvec2(w, w * w);
                    const double share = is_across ? texel.y / (2 * radius) + frustum.warp.curvature * radius / w
                                                   : texel.x / (2 * radius);
                    ASSERT_NEAR(drawn.visibility[row * kWidth + column], expected, share + 2 * kLevel)
                        << point->x << " " << point->z;
                    if (expected < 0.05 || expected > 0.95) continue;
                    checked_near += point->z > -5;
                    checked_far += point->z < -15;
                }
            }
            EXPECT_GT(checked_near, 1000);
            EXPECT_GT(checked_far, 50);
        }
    }
}

TEST_F(WarpedShadow, SampledPcfIsWithoutBias) {
    const SceneState state = view_along({20, 60});
    const auto drawn = [&](FilterMode mode) {
        return draw(bands(), state, "pcf", made::settings_of({0.3, mode, 16}), 512, Warp::lispsm).visibility;
    };
    const std::vector<float> exact = drawn(FilterMode::exact);
    const std::vector<float> sampled = drawn(FilterMode::jittered);
    const made::SamplingError error = made::sampling_error(sampled, exact);
    ASSERT_GT(error.pixels, 5000);
    EXPECT_GT(error.deviation, 0.005);
    EXPECT_LT(error.deviation, 0.1);
    EXPECT_LT(std::abs(error.mean), 5 * error.deviation / std::sqrt(error.pixels));
}

TEST_F(WarpedShadow, ATiltedPlaneHasNoAcne) {
    const Scene scene = made::scene_of({made::polygon({{-30, 0, -50}, {-30, 0, 3}, {30, 0, 3}, {30, 0, -50}}, true)});
    for (const double elevation : {5.0, 20.0, 60.0, 90.0}) {
        for (const double azimuth : {33.0, 120.0, 180.0}) {
            for (const std::string technique : {"hard", "pcf"}) {
                for (const int side : {64, 1024}) {
                    const Drawn drawn = draw(scene, view_along({azimuth, elevation}), technique,
                                             made::settings_of({0.1, FilterMode::automatic, 25}), side, Warp::lispsm);
                    ASSERT_TRUE(drawn.shape.frustum.warp.warps());
                    const auto dark = std::count_if(drawn.visibility.begin(), drawn.visibility.end(),
                                                    [](float v) { return v < 1 - kLevel; });
                    EXPECT_EQ(dark, 0) << technique << " " << side << ", light " << azimuth << " " << elevation;
                }
            }
        }
    }
}

TEST_F(WarpedShadow, ASphereHasNoAcne) {
    const Scene scene = made::scene_of({made::sphere(1, 48)});
    SceneState state;
    state.light = directional_light({40, 35}, 0);
    // A map for one who looks from the side; every facet that is seen from the light faces it.
    state.camera = made::camera_at(2.5 * basis_towards({130, 5}).back, {130, 5});
    const LightFrustum frustum = fit_light_frustum(
        extents_of(scene), state, 1, Fit::axis_aligned, [](auto&) { return 0.1; }, Warp::lispsm);
    ASSERT_GT(frustum.warp.texel_ratio().y, 1.5);
    state.camera = made::camera_at(4.0 * state.light.basis.back, {40, 35});
    for (const int side : {32, 300, 2048}) {
        for (const std::string technique : {"hard", "pcf"}) {
            const std::vector<float> drawn =
                made::draw_visibility(scene, state, technique, made::settings_of({0.1, FilterMode::automatic, 25}),
                                      map_of_size(frustum, side), kWidth, kHeight);
            const auto dark = std::count_if(drawn.begin(), drawn.end(), [](float v) { return v < 1 - kLevel; });
            EXPECT_EQ(dark, 0) << technique << " " << side;
        }
    }
}

// Rows of columns along a long ground: of 512² texels, those near the camera are too few without a warp. Within 6 units 277
// pixels of the ground are wrong without it, and 69 with it.
TEST_F(WarpedShadow, IsFinerNearTheCamera) {
    std::vector<Mesh> meshes{made::ground(0, 60)};
    for (int i = 0; i < 20; ++i) {
        for (const float x : {-3.0f, 2.6f}) {
            const float z = -2.1f * static_cast<float>(i) - 1;
            for (Mesh& side : made::box({x, 0, z}, {x + 0.4f, 3, z + 0.4f})) meshes.push_back(std::move(side));
        }
    }
    const Scene scene = made::scene_of(meshes);
    const SceneState state = view_along({75, 50});
    const ShadowSettings settings = made::settings_of({0.01, FilterMode::automatic, 25});
    const std::vector<float> truth = draw(scene, state, "hard", settings, 8192, Warp::none).visibility;
    const auto wrong_near = [&](Warp warp) {
        const std::vector<float> drawn = draw(scene, state, "hard", settings, 512, warp).visibility;
        int wrong = 0;
        for (int row = 0; row < kHeight; ++row) {
            for (int column = 0; column < kWidth; ++column) {
                const auto point = ground_point(state.camera, column, row);
                if (!point || point->z < -6) continue;
                wrong += drawn[row * kWidth + column] != truth[row * kWidth + column];
            }
        }
        return wrong;
    };
    const int plain = wrong_near(Warp::none);
    const int warped = wrong_near(Warp::lispsm);
    RecordProperty("wrong_plain", plain);
    RecordProperty("wrong_warped", warped);
    EXPECT_GT(plain, 200);
    EXPECT_LT(warped, plain / 3) << "of " << plain;
}

TEST_F(WarpedShadow, TheLawsMapHidesItsTexelsEverywhere) {
    const SceneState state = view_along({20, 60});
    const double radius = 0.3;
    const ShadowSettings settings = made::settings_of({radius, FilterMode::exact, 0});
    const Drawn warped = draw(bands(), state, "pcf", settings, std::nullopt, Warp::lispsm);
    const Drawn plain = draw(bands(), state, "pcf", settings, std::nullopt, Warp::none);
    const glm::dvec2 largest = warped.shape.texel();
    EXPECT_LE(std::max(largest.x, largest.y), radius / settings.technique.law_slope);
    EXPECT_GT(warped.shape.texel_count(), plain.shape.texel_count());
    double sum = 0;
    for (size_t i = 0; i < plain.visibility.size(); ++i) sum += std::abs(plain.visibility[i] - warped.visibility[i]);
    EXPECT_LT(sum / static_cast<double>(plain.visibility.size()), 2 * kLevel);
}

TEST_F(WarpedShadow, IsRefusedByWhatCannotTakeIt) {
    const GpuScene gpu = upload(bands());
    const SceneState state = view_along({20, 60});
    ShadowSettings settings = made::settings_of({0.3, FilterMode::automatic, 25});
    settings.fixed_size = 64;
    settings.warp = Warp::lispsm;
    for (const TechniqueEntry& entry : techniques()) {
        const bool takes = entry.name == "none" || entry.name == "hard" || entry.name == "pcf";
        const auto make = [&] { ShadowRenderer renderer(entry, settings, gpu, state, kAspect); };
        if (takes) {
            EXPECT_NO_THROW(make()) << entry.name;
        } else {
            EXPECT_THROW(make(), InputError) << entry.name;
        }
    }
}

TEST_F(WarpedShadow, AMapThatIsWarpedAndThenIsNotIsRight) {
    const Scene scene = bands();
    const GpuScene gpu = upload(scene);
    const SceneState across = view_along({20, 60});
    SceneState against = across;
    against.light.basis = basis_towards(direction_of(across.camera.basis.back));
    ShadowSettings settings = made::settings_of({0.3, FilterMode::exact, 0});
    settings.fixed_size = 256;
    settings.warp = Warp::lispsm;
    // Points on drawn surfaces are rounded otherwise than stored ones, and a first frame stores.
    settings.skips.needless_storing = false;
    ShadowRenderer renderer(technique_named("pcf"), settings, gpu, across, kAspect);
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    gl::PassTimer timer;
    for (const SceneState& state : {across, against, across}) {
        renderer.draw(gpu, state, target, timer);
        EXPECT_EQ(renderer.map().shape.frustum.warp.warps(), state.light.basis.back == across.light.basis.back);
        EXPECT_EQ(read_visibility(target), draw(scene, state, "pcf", settings, 256, Warp::lispsm).visibility);
    }
}

}  // namespace
}  // namespace stairstep
