// Percentage-closer soft shadows against closed forms: a straight edge parallel to the light's square throws a penumbra
// that is the box filter of its silhouette (light.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/gl/context.h"
#include "tests/renderer/made_edges.h"

namespace stairstep {
namespace {

constexpr int kWidth = made::kEdgeWidth;
constexpr int kHeight = made::kEdgeHeight;
constexpr double kLawSlope = 3.47;

ShadowSettings pcss_settings(FilterMode filter, double law_slope = kLawSlope, int taps = 25) {
    ShadowSettings settings;
    settings.technique.filter = filter;
    settings.technique.law_slope = law_slope;
    settings.technique.filter_taps = taps;
    settings.technique.search_taps = taps;
    settings.radius = 0.1;
    settings.largest_size = 2048;
    return settings;
}

std::vector<float> draw_edge(const made::StraightEdge& edge, const ShadowSettings& settings, int side) {
    const Scene scene = made::scene_of_edge(edge);
    const SceneState state{made::kEdgeCamera, edge.light, {}};
    return made::draw_visibility(scene, state, "pcss", settings, map_of_size(made::fitted(scene, edge.light), side),
                                 kWidth, kHeight);
}

std::vector<float> draw_edge_auto(const made::StraightEdge& edge, const ShadowSettings& settings) {
    const GpuScene gpu = upload(made::scene_of_edge(edge));
    const SceneState state{made::kEdgeCamera, edge.light, {}};
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    const double aspect = static_cast<double>(kWidth) / kHeight;
    ShadowRenderer renderer(technique_named("pcss"), settings, gpu, state, aspect);
    gl::PassTimer timer;
    renderer.draw(gpu, state, target, timer);
    return read_visibility(target);
}

/// Errors against the closed form, in the penumbra and clear of it by a part of the half-width.
struct RampErrors {
    int penumbra = 0;
    double worst = 0;
    double rmse = 0;
    double mean = 0;
    int lit = 0;
    int lit_below_1 = 0;
    int umbra = 0;
    double brightest_umbra = 0;
};

RampErrors ramp_errors(const made::StraightEdge& edge, const std::vector<float>& drawn, double margin = 0.2) {
    RampErrors errors;
    double squares = 0;
    double sum = 0;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const glm::dvec3 point = made::edge_point(column, row);
            const double value = drawn[static_cast<size_t>(row) * kWidth + column];
            const double expected = edge.visibility(point);
            // How far the box reaches across the edge.
            const glm::dvec2 along = glm::abs(edge.along());
            const double reach = edge.radius(point) * (along.x + along.y) * (1 + margin);
            if (edge.distance(point) > reach) {
                ++errors.lit;
                errors.lit_below_1 += value != 1;
            } else if (edge.distance(point) < -reach) {
                ++errors.umbra;
                errors.brightest_umbra = std::max(errors.brightest_umbra, value);
            } else if (expected > 0 && expected < 1) {
                ++errors.penumbra;
                const double error = value - expected;
                errors.worst = std::max(errors.worst, std::abs(error));
                squares += error * error;
                sum += error;
            }
        }
    }
    errors.rmse = std::sqrt(squares / std::max(errors.penumbra, 1));
    errors.mean = sum / std::max(errors.penumbra, 1);
    return errors;
}

class Pcss : public testing::TestWithParam<Light::Kind> {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

constexpr double kAngles[] = {0, 17, 45, 90, 133, 200, 270, 333};

void expect_ramp(const char* what, const made::StraightEdge& edge, const RampErrors& e, double tolerance) {
    SCOPED_TRACE(testing::Message() << what << ", angle " << edge.angle_deg);
    ASSERT_GT(e.penumbra, 10000) << "the picture should show the penumbra";
    EXPECT_LE(e.worst, tolerance);
    EXPECT_EQ(e.lit_below_1, 0);
    EXPECT_EQ(e.brightest_umbra, 0);
}

// An edge along the texels' sides lies up to half a texel from where sampling puts it: V is off by a/(4r) at most.
TEST_P(Pcss, LevelsAreTheRampButForHalfATexel) {
    constexpr double kRounding = 2e-3;
    for (const double angle : kAngles) {
        const made::StraightEdge edge = made::straight_edge(GetParam(), angle);
        // The half-width is some 40 of the map's texels for a spot, 75 for a directional light; levels are up to 1.5 times
        // as fine as they must.
        for (const double law_slope : {kLawSlope, 20.0}) {
            const RampErrors e = ramp_errors(edge, draw_edge(edge, pcss_settings(FilterMode::exact, law_slope), 1500));
            expect_ramp("levels", edge, e, 1 / (4 * law_slope) + kRounding);
        }
        const RampErrors own = ramp_errors(edge, draw_edge_auto(edge, pcss_settings(FilterMode::automatic)));
        expect_ramp("auto", edge, own, 1 / (4 * kLawSlope) + kRounding);
    }
}

// The width of the ramp is light.h's: a box 5 % wider or narrower fits worse.
TEST_P(Pcss, TheHalfWidthIsTheLights) {
    const made::StraightEdge edge = made::straight_edge(GetParam(), 17);
    const std::vector<float> drawn = draw_edge(edge, pcss_settings(FilterMode::exact, 12), 1500);
    const auto squares = [&](double factor) {
        double sum = 0;
        for (int row = 0; row < kHeight; ++row) {
            for (int column = 0; column < kWidth; ++column) {
                const glm::dvec3 point = made::edge_point(column, row);
                const double expected = edge.visibility(point, factor * edge.radius(point));
                sum += std::pow(drawn[static_cast<size_t>(row) * kWidth + column] - expected, 2);
            }
        }
        return sum;
    };
    const double here = squares(1);
    EXPECT_LT(here, squares(0.95) / 4);
    EXPECT_LT(here, squares(1.05) / 4);
}

// Taps find the ramp but for noise. Searches by few taps miss blockers at the penumbra's lit rim, so these take many.
TEST_P(Pcss, TapsAreWithoutBias) {
    // Pictures that show all of the penumbra's width, so that a disk's and a box's ramps have the same mean.
    const std::vector<double> angles =
        GetParam() == Light::Kind::spot ? std::vector<double>{17, 270} : std::vector<double>{17, 90, 200};
    for (const double angle : angles) {
        const made::StraightEdge edge = made::straight_edge(GetParam(), angle);
        for (const FilterMode mode :
             {FilterMode::jittered, FilterMode::regular, FilterMode::rotated, FilterMode::poisson}) {
            SCOPED_TRACE(testing::Message() << name(mode) << ", angle " << angle);
            ShadowSettings settings = pcss_settings(mode);
            settings.technique.search_taps = 256;
            const RampErrors e = ramp_errors(edge, draw_edge(edge, settings, 1500));
            // Poisson taps that aren't turned have a middle of their own.
            EXPECT_LE(std::abs(e.mean), mode == FilterMode::poisson ? 0.02 : 0.004);
            EXPECT_LE(e.rmse, 0.1);
            EXPECT_EQ(e.lit_below_1, 0);
            EXPECT_EQ(e.brightest_umbra, 0);
        }
    }
}

// As a light grows, pixels change the level that they filter on: by no more than one of two levels is off by at most, a/(4r),
// and seldom at once.
TEST_P(Pcss, LevelsChangeWithoutLeaps) {
    constexpr double kStep = 1.03;
    const ShadowSettings settings = pcss_settings(FilterMode::exact);
    for (const double angle : {0.0, 200.0}) {
        SCOPED_TRACE(angle);
        std::vector<float> drawn;
        made::StraightEdge before;
        for (double softness = 0.4; softness < 1; softness *= kStep) {
            const made::StraightEdge edge = made::straight_edge(GetParam(), angle, softness);
            const std::vector<float> now = draw_edge(edge, settings, 1500);
            double sum = 0;
            double most = 0;
            for (size_t i = 0; i < now.size() && !drawn.empty(); ++i) {
                const glm::dvec3 point = made::edge_point(static_cast<int>(i % kWidth), static_cast<int>(i / kWidth));
                const double wrong = now[i] - drawn[i] - (edge.visibility(point) - before.visibility(point));
                most = std::max(most, std::abs(wrong));
                sum += std::abs(wrong);
            }
            EXPECT_LE(most, 1 / (4 * kLawSlope) + 4e-3);
            EXPECT_LE(sum / (kWidth * kHeight), 0.01);
            drawn = now;
            before = edge;
        }
    }
}

// A light without size has no penumbra; what remains is a texel's width.
TEST_P(Pcss, APointsShadowIsHard) {
    for (const double angle : {0.0, 17.0, 133.0}) {
        const made::StraightEdge edge = made::straight_edge(GetParam(), angle, 0);
        for (const FilterMode mode : {FilterMode::exact, FilterMode::jittered, FilterMode::rotated}) {
            const std::vector<float> drawn = draw_edge(edge, pcss_settings(mode), 1024);
            const double texel = GetParam() == Light::Kind::spot ? 2.0 / 1024 : 5.0 / 1024;
            int wrong = 0;
            int dark = 0;
            int lit = 0;
            for (int row = 0; row < kHeight; ++row) {
                for (int column = 0; column < kWidth; ++column) {
                    const double distance = edge.distance(made::edge_point(column, row));
                    if (std::abs(distance) < 2.5 * texel) continue;
                    const float value = drawn[static_cast<size_t>(row) * kWidth + column];
                    wrong += value != (distance > 0 ? 1.0f : 0.0f);
                    dark += value == 0;
                    lit += value == 1;
                }
            }
            EXPECT_EQ(wrong, 0) << name(mode) << ", angle " << angle;
            EXPECT_GT(dark, 4000);
            EXPECT_GT(lit, 4000);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(OfEachLight, Pcss, testing::Values(Light::Kind::directional, Light::Kind::spot),
                         [](const auto& info) { return info.param == Light::Kind::spot ? "spot" : "directional"; });

class PcssAcne : public testing::Test {
  protected:
    /// Everywhere in the picture, or within a part of its height of its middle, on each fixed map and on one that sizes
    /// itself.
    void expect_lit(const Scene& scene, const Light& light, const Camera& camera, double within = 9) {
        const GpuScene gpu = upload(scene);
        const SceneState state{camera, light, {}};
        const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
        gl::PassTimer timer;
        for (const int side : {0, 64, 300, 2048}) {
            for (const FilterMode mode : {FilterMode::exact, FilterMode::rotated}) {
                if (side == 0 && mode != FilterMode::exact) continue;
                ShadowSettings settings = pcss_settings(mode);
                if (side > 0) settings.fixed_size = side;
                ShadowRenderer renderer(technique_named("pcss"), settings, gpu, state,
                                        static_cast<double>(kWidth) / kHeight);
                renderer.draw(gpu, state, target, timer);
                const std::vector<float> drawn = read_visibility(target);
                int dark = 0;
                for (int row = 0; row < kHeight; ++row) {
                    for (int column = 0; column < kWidth; ++column) {
                        const double away = std::hypot(column + 0.5 - kWidth / 2.0, row + 0.5 - kHeight / 2.0);
                        dark += away < within * kHeight && drawn[static_cast<size_t>(row) * kWidth + column] < 1;
                    }
                }
                EXPECT_EQ(dark, 0) << name(mode) << " " << side;
            }
        }
    }

    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

TEST_F(PcssAcne, ATiltedPlaneHasNone) {
    const Scene scene = made::scene_of({made::polygon({{-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}}, true)});
    for (const double elevation : {8.0, 20.0, 60.0, 90.0}) {
        SCOPED_TRACE(elevation);
        const glm::dvec3 towards = basis_towards({33, elevation}).back;
        expect_lit(scene, directional_light({33, elevation}, 0.08), made::camera_down({0, 3, 0}));
        expect_lit(scene, spot_light(5.0 * towards, {0, 0, 0}, 0.2, 80), made::camera_down({0, 1, 0}));
    }
}

// Seen from where the light is, a convex body never shades itself.
TEST_F(PcssAcne, ASphereHasNone) {
    const Scene scene = made::scene_of({made::sphere(1, 48)});
    const Direction direction{40, 35};
    const glm::dvec3 towards = basis_towards(direction).back;
    // Right at the rim facets are steeper than slopes are kept.
    const double rim = std::sqrt(3.0 / 15) / 2;
    const Camera camera = made::camera_at(4.0 * towards, direction);
    expect_lit(scene, directional_light(direction, 0.08), camera, 0.98 * rim);
    expect_lit(scene, spot_light(4.0 * towards, {0, 0, 0}, 0.2, 40), camera, 0.98 * rim);
}

}  // namespace
}  // namespace stairstep
