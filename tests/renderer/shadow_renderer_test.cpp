// Maps that size themselves frame after frame: what decides their texels, where those lie, and that nothing of a former
// map shows.
#include "renderer/shadow_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/gl/context.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr double kAspect = static_cast<double>(kWidth) / kHeight;
constexpr double kHalfTangent = 0.1;
constexpr double kSpotHeight = 5;

class Renderer : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
    std::optional<gl::PassTimer> timer_{std::in_place};
};

/// A sheet at height 0 of its mover over a ground at height 0, the edge along z; light and camera straight above.
Scene sheet_scene() {
    Mesh sheet = made::polygon({{-9, 0, -9}, {-9, 0, 9}, {0.013f, 0, 9}, {0.013f, 0, -9}}, true);
    sheet.mover = 0;
    return made::scene_of({sheet, made::ground(0, 9)});
}

Light light_above(Light::Kind kind) {
    if (kind == Light::Kind::directional) return directional_light({0, 90}, kHalfTangent);
    return {Light::Kind::spot, basis_towards({0, 90}), {0, kSpotHeight, 0}, kHalfTangent * kSpotHeight, 1, 60};
}

SceneState sheet_state(double height, double eye_height, Light::Kind kind = Light::Kind::directional) {
    glm::dmat4 lifted(1);
    lifted[3].y = height;
    // Below the sheet.
    return {made::camera_down({0, eye_height, 0}), light_above(kind), {lifted}};
}

ShadowSettings auto_settings(double radius = 0.1) {
    ShadowSettings settings;
    settings.radius = radius;
    settings.largest_size = 2048;
    return settings;
}

/// The law's texel for the sheet at this height, no smaller than a pixel, in the light plane.
double needed(double height, double eye_height, double slope, Light::Kind kind = Light::Kind::directional) {
    const double pixel = pixel_footprint(made::camera_down({}), eye_height, kHeight);
    if (kind == Light::Kind::directional) return std::max(kHalfTangent * height / slope, pixel);
    const double radius = kHalfTangent * kSpotHeight * (1 / (kSpotHeight - height) - 1 / kSpotHeight);
    return std::max(radius / slope, pixel / kSpotHeight);
}

// Light, sheet and ground are square to each other: every pixel of the penumbra needs the same.
TEST_F(Renderer, PcssTakesTheTexelThatThePixelsNeed) {
    const GpuScene gpu = upload(sheet_scene());
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    struct Case {
        double height, eye_height;
    };
    // The last two are limited by the picture.
    for (const auto& [height, eye] :
         std::vector<Case>{{3, 1}, {2, 0.9}, {1.3, 1.2}, {0.5, 0.4}, {0.1, 0.09}, {1.3, 0.2}}) {
        for (const NeedStatistic::Kind kind :
             {NeedStatistic::Kind::extreme, NeedStatistic::Kind::percentile, NeedStatistic::Kind::tiles}) {
            for (const Light::Kind light : {Light::Kind::directional, Light::Kind::spot}) {
                SCOPED_TRACE(testing::Message() << "height " << height << ", eye " << eye);
                ShadowSettings settings = auto_settings();
                settings.statistic.kind = kind;
                const SceneState state = sheet_state(height, eye, light);
                ShadowRenderer renderer(technique_named("pcss"), settings, gpu, state, kAspect);
                renderer.draw(gpu, state, target, *timer_);
                const double wanted = needed(height, eye, settings.technique.law_slope, light);
                const glm::dvec2 texel = renderer.map().shape.texel();
                EXPECT_EQ(texel.x, texel.y);
                EXPECT_LE(texel.x, wanted * (1 + 1e-5));
                EXPECT_GT(texel.x, wanted * 8 / 9 * (1 - 1e-5));
            }
        }
    }
}

TEST_F(Renderer, PcssGrowsTheMapAtOnceAndShrinksItWithPatience) {
    const GpuScene gpu = upload(sheet_scene());
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    ShadowSettings settings = auto_settings();
    settings.patience.frames = 7;
    const SceneState high = sheet_state(3, 0.3);
    const SceneState low = sheet_state(0.6, 0.3);
    ShadowRenderer renderer(technique_named("pcss"), settings, gpu, high, kAspect);
    const auto draw = [&](const SceneState& state) {
        renderer.draw(gpu, state, target, *timer_);
        return renderer.map().shape.texel().x;
    };
    const double coarse = draw(high);
    for (int i = 0; i < 10; ++i) ASSERT_EQ(draw(high), coarse) << "a still picture keeps its map";
    EXPECT_EQ(draw(low), coarse) << "needs are known once they were drawn";
    const double fine = draw(low);
    EXPECT_LE(fine, needed(0.6, 0.3, settings.technique.law_slope) * (1 + 1e-5));
    EXPECT_LT(fine, coarse / 4);
    // The frame that first needs less was drawn before the first of the patience's.
    draw(high);
    for (int i = 1; i < settings.patience.frames; ++i) ASSERT_EQ(draw(high), fine) << i;
    EXPECT_EQ(draw(high), coarse);
}

// Nothing in the umbra or the light asks for texels: only what shows the penumbra does.
TEST_F(Renderer, OnlyThePenumbraNeedsTexels) {
    const GpuScene gpu = upload(sheet_scene());
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    const SceneState state = sheet_state(2, 1);
    ShadowRenderer renderer(technique_named("pcss"), auto_settings(), gpu, state, kAspect);
    renderer.draw(gpu, state, target, *timer_);
    std::vector<float> needs(kWidth * kHeight);
    gl::GetTextureImage(target.need.id(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(needs.size() * 4), needs.data());
    const double texel = renderer.map().shape.texel().x;
    const double wanted = needed(2, 1, auto_settings().technique.law_slope);
    int wrong = 0;
    int penumbra = 0;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const double x = made::point_below(state.camera, column, row, kWidth, kHeight, 0).x;
            const float need = needs[static_cast<size_t>(row) * kWidth + column];
            const double from_rim = 2 * kHalfTangent - std::abs(x - 0.013);
            if (from_rim > texel) {
                wrong += std::abs(need - wanted) > 1e-3 * wanted;
                ++penumbra;
            } else if (from_rim < -texel) {
                wrong += need < 1e30f;
            }
        }
    }
    EXPECT_GT(penumbra, 3000);
    EXPECT_EQ(wrong, 0);
}

// A scene in which texels would crawl: boxes on a ground, under a light that turns.
Scene boxes_scene() {
    std::vector<Mesh> meshes = made::box({-0.5f, 0, -0.4f}, {0.4f, 1.1f, 0.5f});
    for (Mesh& side : made::box({0.9f, 0.2f, -0.9f}, {1.4f, 0.5f, -0.2f})) meshes.push_back(std::move(side));
    meshes.push_back(made::ground(0, 9));
    return made::scene_of(meshes);
}

SceneState boxes_state(double t) {
    SceneState state;
    state.camera = camera_looking_at({1 + t, 3, 4}, {0, 0.3, 0}, 40, 0.5, 40);
    state.light = directional_light({40 + 50 * t, 35 + 20 * t}, 0.05);
    return state;
}

TEST_F(Renderer, TexelsStayOnTheirGridAsTheLightTurns) {
    const GpuScene gpu = upload(boxes_scene());
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    for (const std::string technique : {"pcf", "pcss", "vsm", "esm"}) {
        for (const std::optional<int> fixed : {std::optional<int>(), std::optional<int>(300)}) {
            for (const Fit fit : {Fit::axis_aligned, Fit::smallest_rectangle}) {
                SCOPED_TRACE(testing::Message() << technique << " " << fixed.value_or(0));
                ShadowSettings settings = auto_settings(0.06);
                settings.fixed_size = fixed;
                settings.fit = fit;
                ShadowRenderer renderer(technique_named(technique), settings, gpu, boxes_state(0), kAspect);
                int capacity = renderer.map().capacity;
                int reservations = 0;
                for (int frame = 0; frame <= 12; ++frame) {
                    renderer.draw(gpu, boxes_state(frame / 12.0), target, *timer_);
                    const ShadowMap& map = renderer.map();
                    ASSERT_GE(map.capacity, capacity) << "memory never shrinks";
                    reservations += map.capacity != capacity;
                    ASSERT_LE(reservations, 3) << "it grows by doubling";
                    capacity = map.capacity;
                    ASSERT_LE(std::max(map.shape.width, map.shape.height), capacity);
                    if (fixed) {
                        ASSERT_EQ(map.shape.width, *fixed);
                        ASSERT_EQ(map.shape.height, *fixed);
                        continue;
                    }
                    const glm::dvec2 texel = map.shape.texel();
                    ASSERT_EQ(texel.x, texel.y);
                    ASSERT_NE(map.shape.limit, ShadowMapShape::Limit::largest_size);
                    for (const int axis : {0, 1}) {
                        const double first = map.shape.frustum.low[axis] / texel[axis];
                        ASSERT_EQ(first, std::round(first)) << "frame " << frame;
                    }
                }
            }
        }
    }
}

// Casters all over the map, up to its borders, so that texels left from a larger map would cast shadows.
TEST_F(Renderer, NothingOfALargerMapShowsInASmallerOne) {
    const GpuScene gpu = upload(boxes_scene());
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    const SceneState large_state = boxes_state(0.8);
    const SceneState state = boxes_state(0.1);
    const auto shape_of = [&](const SceneState& of, int width, int height) {
        ShadowMapShape shape = map_of_size(made::fitted(boxes_scene(), of.light), width);
        shape.height = height;
        return shape;
    };
    struct Case {
        const char* technique;
        FilterMode filter;
        double radius;
    };
    for (const Case& c : {Case{"hard", FilterMode::automatic, 0.1},
                          {"pcf", FilterMode::exact, 0.1},
                          {"pcf", FilterMode::rotated, 0.3},
                          {"pcf", FilterMode::jittered, 0.3},
                          {"pcss", FilterMode::exact, 0.1},
                          {"pcss", FilterMode::rotated, 0.1},
                          {"vsm", FilterMode::automatic, 0.1},
                          {"esm", FilterMode::automatic, 0.1}}) {
        for (const glm::ivec2 small : {glm::ivec2(90, 61), glm::ivec2(33, 128), glm::ivec2(1, 1)}) {
            SCOPED_TRACE(testing::Message() << c.technique << " " << name(c.filter) << " " << small.x);
            ShadowSettings settings = auto_settings(c.radius);
            settings.technique.filter = c.filter;
            settings.fixed_size = 500;
            const auto fresh = [&] {
                return ShadowRenderer(technique_named(c.technique), settings, gpu, state, kAspect);
            };
            ShadowRenderer used = fresh();
            used.draw_with(shape_of(large_state, 500, 500), gpu, large_state, target, *timer_);
            used.draw_with(shape_of(state, 380, 500), gpu, state, target, *timer_);
            const std::vector<float> former = read_visibility(target);
            used.draw_with(shape_of(state, small.x, small.y), gpu, state, target, *timer_);
            const std::vector<float> after = read_visibility(target);
            ShadowRenderer unused = fresh();
            unused.draw_with(shape_of(state, small.x, small.y), gpu, state, target, *timer_);
            const std::vector<float> alone = read_visibility(target);
            // A prefiltered map's memory is of another size, and places in it are rounded otherwise.
            const bool prefiltered = c.technique == std::string("vsm") || c.technique == std::string("esm");
            float worst = 0;
            for (size_t i = 0; i < after.size(); ++i) worst = std::max(worst, std::abs(after[i] - alone[i]));
            EXPECT_LE(worst, prefiltered ? 1e-3f : 0.0f);
            EXPECT_NE(after, former);
        }
    }
}

TEST_F(Renderer, MeasuringDoesntChangeThePicture) {
    const GpuScene gpu = upload(boxes_scene());
    const SceneState state = boxes_state(0.3);
    for (const Show show : {Show::colour, Show::visibility}) {
        const FrameTarget target = make_frame_target(show, kWidth, kHeight, 1);
        ShadowSettings settings = auto_settings();
        ShadowRenderer measuring(technique_named("pcss"), settings, gpu, state, kAspect);
        measuring.draw(gpu, state, target, *timer_);
        const ShadowMapShape shape = measuring.map().shape;
        const Image colour = show == Show::colour ? read_colour(target) : Image(1, 1, 3);
        const std::vector<float> values = show == Show::visibility ? read_visibility(target) : std::vector<float>();
        settings.fixed_size = settings.largest_size;
        settings.technique.filter = FilterMode::exact;
        ShadowRenderer plain(technique_named("pcss"), settings, gpu, state, kAspect);
        plain.draw_with(shape, gpu, state, target, *timer_);
        if (show == Show::colour) {
            EXPECT_EQ(read_colour(target).pixels, colour.pixels);
        } else {
            EXPECT_EQ(read_visibility(target), values);
        }
    }
}

// A still picture's surfaces stay where they were stored; not where others have stored theirs since.
TEST_F(Renderer, SurfacesThatAnotherStoredAreNotTakenForOnesOwn) {
    const GpuScene with_sheet = upload(sheet_scene());
    const GpuScene bare = upload(made::scene_of({made::ground(0, 9)}));
    const FrameTarget target = make_frame_target(Show::visibility, kWidth, kHeight, 1);
    const GpuScene patch = upload(made::scene_of({made::ground(0, 0.2)}));
    const SceneState state = sheet_state(2, 1.5);
    SceneState still = state;
    still.movers.clear();
    for (const char* technique : {"hard", "pcf", "pcss"}) {
        SCOPED_TRACE(technique);
        ShadowRenderer one(technique_named(technique), auto_settings(), with_sheet, state, kAspect);
        ShadowRenderer other(technique_named(technique), auto_settings(), bare, still, kAspect);
        for (int frame = 0; frame < 6; ++frame) one.draw(with_sheet, state, target, *timer_);
        const std::vector<float> alone = read_visibility(target);
        EXPECT_LT(*std::min_element(alone.begin(), alone.end()), 0.5f);
        for (int frame = 0; frame < 4; ++frame) other.draw(bare, still, target, *timer_);
        const std::vector<float> lit = read_visibility(target);
        EXPECT_EQ(*std::min_element(lit.begin(), lit.end()), 1);
        one.draw(with_sheet, state, target, *timer_);
        EXPECT_EQ(read_visibility(target), alone);
        // Nor are depths that another drew as it lit: they tell where surfaces are.
        ShadowSettings always_drawn = auto_settings();
        always_drawn.skips.hidden_surfaces = false;
        ShadowRenderer drawing(technique_named(technique), always_drawn, patch, still, kAspect);
        drawing.draw(patch, still, target, *timer_);
        one.draw(with_sheet, state, target, *timer_);
        EXPECT_EQ(read_visibility(target), alone);
        // And one's own no more where something has moved, there and back. What pcss needed meanwhile stays for a while.
        if (std::string(technique) == "pcss") continue;
        one.draw(with_sheet, sheet_state(1, 1.5), target, *timer_);
        one.draw(with_sheet, state, target, *timer_);
        one.draw(with_sheet, state, target, *timer_);
        EXPECT_EQ(read_visibility(target), alone);
    }
}

TEST_F(Renderer, ATargetOfSeveralSamplesLeavesTheSizeAsItIs) {
    const GpuScene gpu = upload(sheet_scene());
    const FrameTarget single = make_frame_target(Show::colour, kWidth, kHeight, 1);
    const FrameTarget several = make_frame_target(Show::colour, kWidth, kHeight, 4);
    const SceneState high = sheet_state(3, 0.3);
    const SceneState low = sheet_state(0.6, 0.3);
    ShadowRenderer renderer(technique_named("pcss"), auto_settings(), gpu, high, kAspect);
    const auto draw = [&](const SceneState& state, const FrameTarget& target) {
        renderer.draw(gpu, state, target, *timer_);
        return renderer.map().shape.texel().x;
    };
    // Unknown needs: the guess stays.
    const double guess = draw(high, several);
    EXPECT_EQ(draw(high, several), guess);
    const double coarse = draw(high, single);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(draw(low, several), coarse);
    // Drawn once where it can be measured, the need is known.
    EXPECT_EQ(draw(low, single), coarse);
    EXPECT_LT(draw(low, several), coarse);
}

}  // namespace
}  // namespace stairstep
