// What pictures show of lights: planted truths, and that "no shadow" is never wrong, whatever the technique.
#include "renderer/shadow_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "renderer/gl/context.h"
#include "renderer/scenes/mesh_shapes.h"
#include "stimuli/random.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr int kWidth = 100;
constexpr int kHeight = 76;
constexpr double kAspect = static_cast<double>(kWidth) / kHeight;

Mesh box_mesh(const glm::dvec3& low, const glm::dvec3& high) {
    Mesh mesh;
    append_box(mesh, low, high);
    return mesh;
}

/// Everything but that pixels are stored before they are lit: what is compared has the same surfaces.
const Skips kFullyDrawn =
    skips_without("unseen-triangles,unseen-shadows,hidden-shadows,unchanged-maps,unchanged-pixels,even-texels");

struct Method {
    const char* technique;
    FilterMode filter;
};
constexpr Method kMethods[]{{"hard", FilterMode::automatic}, {"pcf", FilterMode::exact},
                            {"pcf", FilterMode::rotated},    {"pcss", FilterMode::exact},
                            {"pcss", FilterMode::rotated},   {"vsm", FilterMode::automatic}};

ShadowSettings settings_of(const Method& method, const Skips& skips, std::optional<int> side) {
    ShadowSettings settings;
    settings.technique.filter = method.filter;
    settings.radius = 0.06;
    settings.fixed_size = side;
    settings.largest_size = 1024;
    settings.skips = skips;
    return settings;
}

/// An exact box of a constant radius can't be any number of texels wide; the law's maps make it few.
std::optional<int> side_of(const Method& method) {
    const bool by_law = method.filter == FilterMode::exact && std::string(method.technique) == "pcf";
    return by_law ? std::nullopt : std::optional(128);
}

/// A technique that answers what a picture shows, and draws it.
class Asked {
  public:
    Asked(const Method& method, const GpuScene& scene, const SceneState& state)
        : shadow_(technique_named(method.technique), settings_of(method, {}, side_of(method)), scene, state, kAspect,
                  glm::dvec3(0)),
          full_(technique_named(method.technique), settings_of(method, kFullyDrawn, side_of(method)), scene, state,
                kAspect) {}

    /// nullopt where bounds already tell that there is no shadow.
    std::optional<Shown> shown(const GpuScene& scene, const SceneState& state, const FrameTarget& target) {
        const DrawList all = draw_list(scene, state, {}, Which::all, true);
        const ShadowMapShape shape = shadow_.choose(scene, state, kAspect, kHeight, false);
        gl::ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        surfaces_.draw(scene, state, all, target);
        const auto question = shadow_.question(shape, state, {});
        if (!question) return std::nullopt;
        return query_.ask(scene, state, target, std::span(&*question, 1)).front();
    }
    std::vector<float> visibility(const GpuScene& scene, const SceneState& state, const FrameTarget& target) {
        full_.draw(scene, state, target, timer_);
        return read_visibility(target);
    }

  private:
    SurfacePass surfaces_;
    ShadowQuery query_;
    LightShadow shadow_;
    ShadowRenderer full_;
    gl::PassTimer timer_;
};

/// A box around the origin over a ground: what renderers are made for, so that radii are those of the origin.
Scene first_scene() {
    return made::scene_of({box_mesh({-1, -1, -1}, {1, 1, 1}), made::ground(-1, 9)});
}

SceneState first_state() {
    SceneState state;
    state.camera = camera_looking_at({1, 3, 4}, {0, 0, 0}, 40, 0.5, 40);
    state.light = directional_light({40, 50}, 0.05);
    return state;
}

class ShadowQueries : public testing::Test {
  protected:
    std::optional<Shown> shown(const Scene& scene, const SceneState& state, const Method& method = kMethods[0]) {
        const GpuScene gpu = upload(scene);
        Asked asked(method, gpu, state);
        return asked.shown(gpu, state, target_);
    }

    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
    const FrameTarget target_ = make_frame_target(Show::visibility, kWidth, kHeight, 1);
};

/// A lamp over a box behind a wall, seen from the wall's other side.
Scene behind_wall(const std::vector<Mesh>& wall) {
    std::vector<Mesh> meshes = wall;
    meshes.push_back(box_mesh({1.7, 0.3, -0.3}, {2.2, 0.8, 0.3}));
    meshes.push_back(made::ground(0, 12));
    return made::scene_of(meshes);
}

SceneState before_wall() {
    SceneState state;
    state.camera = camera_looking_at({-3, 1, 0}, {0, 0.6, 0}, 45, 0.1, 40);
    state.light = spot_light({2, 3, 0}, {2, 0, 0.01}, 0.05, 30);
    return state;
}

TEST_F(ShadowQueries, ALampBehindAWallShowsNothing) {
    for (const Method& method : kMethods) {
        SCOPED_TRACE(method.technique);
        const Scene whole = behind_wall({box_mesh({0, 0, -6}, {0.1, 5, 6})});
        EXPECT_EQ(shown(whole, before_wall(), method), Shown::nothing);
        EXPECT_EQ(shown(behind_wall({}), before_wall(), method), Shown::shadow);
        const Scene holed = behind_wall({box_mesh({0, 0, -6}, {0.1, 5, -0.15}), box_mesh({0, 0, 0.15}, {0.1, 5, 6})});
        EXPECT_EQ(shown(holed, before_wall(), method), Shown::shadow);
    }
}

// A wall's own box isn't in the way of its own faces, nor of what stands before it.
TEST_F(ShadowQueries, AWallDoesNotShadeItsLitSide) {
    const Scene scene = made::scene_of({box_mesh({0, -1, -6}, {0.1, 5, 6})});
    SceneState state = before_wall();
    state.light = directional_light({-90, 20}, 0.05);
    for (const Method& method : kMethods) {
        const Shown wanted = std::string(method.technique) == "vsm" ? Shown::shadow : Shown::light;
        EXPECT_EQ(shown(scene, state, method), wanted) << method.technique;
    }
    state.light = directional_light({90, 20}, 0.05);
    for (const Method& method : kMethods) EXPECT_EQ(shown(scene, state, method), Shown::nothing) << method.technique;
}

// A shadow straight below a box, whose side runs beside the picture's: a pixel more or less of it.
TEST_F(ShadowQueries, AShadowThatTouchesThePictureIsSeen) {
    SceneState state;
    state.camera = made::camera_down({0, 5, 0});
    state.light = directional_light({0, 90}, 0);
    const double pixel = pixel_footprint(state.camera, 5, kHeight);
    for (const double side : {-1.0, 1.0}) {
        const auto scene_with = [&](double inside_px) {
            const double near = side * (kWidth / 2.0 - inside_px) * pixel;
            const double far = near + side;
            return made::scene_of(
                {box_mesh({std::min(near, far), 0.2, -0.1}, {std::max(near, far), 0.3, 0.1}), made::ground(0, 9)});
        };
        EXPECT_EQ(shown(scene_with(1), state), Shown::shadow);
        EXPECT_EQ(shown(scene_with(0.6), state), Shown::shadow);
        // Texels are at most 1/128, and a look is widened by two; bounds may know it as well.
        const auto outside = shown(scene_with(-2.5 / 128 / pixel), state);
        EXPECT_NE(outside, Shown::shadow);
    }
}

TEST_F(ShadowQueries, ASpotsShadowOutsideThePictureIsUnseen) {
    // The camera sees the cone's near half, and the box shades the far one.
    SceneState state;
    state.camera = camera_looking_at({0, 1.5, 0.01}, {0, 0, 0}, 40, 0.1, 40);
    state.light = spot_light({0, 3, 0}, {0, 0, 0.01}, 0.05, 50);
    const auto scene_at = [](double x) {
        return made::scene_of({box_mesh({x, 0.2, -0.2}, {x + 0.3, 0.6, 0.2}), made::ground(0, 9)});
    };
    for (const Method& method : kMethods) {
        if (std::string(method.technique) == "vsm") continue;
        const auto far = shown(scene_at(1.9), state, method);
        EXPECT_TRUE(!far || far == Shown::light) << method.technique;
        EXPECT_EQ(shown(scene_at(0.2), state, method), Shown::shadow) << method.technique;
    }
}

/// Boxes that stand about or float, a wall here and there.
Scene random_scene(Random& random) {
    const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
    std::vector<Mesh> meshes{made::ground(-1, 9)};
    const uint64_t count = 1 + random.below(4);
    for (uint64_t i = 0; i < count; ++i) {
        const glm::dvec3 half(between(0.05, 0.5), between(0.05, 0.5), between(0.05, 0.5));
        glm::dmat4 place = rotate_about({0, 0, 0}, {0, 1, 0}, random.below(2) ? between(0, 90) : 0) *
                           rotate_about({0, 0, 0}, {1, 0, 0}, random.below(3) == 0 ? between(0, 90) : 0);
        place[3] = glm::dvec4(between(-2.5, 2.5), between(-1, 1.2), between(-2.5, 2.5), 1);
        append_box(meshes.emplace_back(), half, place);
    }
    if (random.below(2)) meshes.push_back(box_mesh({between(-1, 1), -1, -4}, {1.1, between(0, 2), 4}));
    return made::scene_of(meshes);
}

SceneState random_state(Random& random) {
    const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
    const auto place = [&](double low, double high) {
        return glm::dvec3(between(-3, 3), between(low, high), between(-3, 3));
    };
    SceneState state;
    state.camera = camera_looking_at(place(0, 3), place(-1, -0.5), between(10, 60), 0.05, 40);
    if (random.below(2)) {
        state.light = directional_light({between(-180, 180), between(8, 90)}, between(0, 0.1));
    } else {
        // The origin is before the spot, which a constant filter's radius asks for.
        const glm::dvec3 target(between(-1, 1), -1.25, between(-1, 1));
        state.light = spot_light(place(1, 3), target, between(0, 0.1), between(10, 60));
    }
    return state;
}

/// Of the pixels that have stored a surface, the most.
float most_on_surfaces(const std::vector<float>& visibility, const FrameTarget& target) {
    std::vector<glm::vec4> planes(visibility.size());
    gl::GetTextureImage(target.planes.id(), 0, GL_RGBA, GL_FLOAT,
                        static_cast<GLsizei>(planes.size() * sizeof(glm::vec4)), planes.data());
    float most = 0;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const size_t pixel = static_cast<size_t>(row) * kWidth + column;
            // Textures begin at the bottom.
            const glm::vec4& plane = planes[static_cast<size_t>(kHeight - 1 - row) * kWidth + column];
            if (glm::vec3(plane) != glm::vec3(0)) most = std::max(most, visibility[pixel]);
        }
    }
    return most;
}

// "No shadow" is the truth: fully drawn, visibility is what it is without shadows. "Nothing": and that is dark.
TEST_F(ShadowQueries, WhatIsUnseenIsNotThere) {
    const GpuScene first = upload(first_scene());
    Asked none({"none", FilterMode::automatic}, first, first_state());
    for (const Method& method : kMethods) {
        SCOPED_TRACE(testing::Message() << method.technique << " " << name(method.filter));
        Asked asked(method, first, first_state());
        Random random(7);
        std::map<std::optional<Shown>, int> counts;
        int shadows_there = 0;
        constexpr int kCases = 100;
        for (int i = 0; i < kCases; ++i) {
            const GpuScene scene = upload(random_scene(random));
            const SceneState state = random_state(random);
            const std::optional<Shown> shown = asked.shown(scene, state, target_);
            ++counts[shown];
            const std::vector<float> bare = none.visibility(scene, state, target_);
            const std::vector<float> full = asked.visibility(scene, state, target_);
            double worst = 0;
            for (size_t j = 0; j < bare.size(); ++j) worst = std::max<double>(worst, std::abs(bare[j] - full[j]));
            // Areas of a filter add up to 1 but for rounding.
            constexpr double kRounding = 1e-5;
            shadows_there += worst > kRounding;
            if (!shown || shown == Shown::shadow) continue;
            EXPECT_LE(worst, kRounding) << "case " << i;
            if (shown == Shown::nothing) {
                EXPECT_EQ(most_on_surfaces(bare, target_), 0) << "case " << i;
            }
        }
        // Not by saying "shadow" all the time: what is there is most of what it says.
        EXPECT_GT(counts[Shown::nothing], 2);
        EXPECT_GT(counts[Shown::shadow], 25);
        EXPECT_GE(counts[Shown::shadow], shadows_there);
        if (std::string(method.technique) == "vsm") continue;
        EXPECT_GT(counts[Shown::light], 5);
        EXPECT_LT(counts[Shown::shadow], 1.3 * shadows_there + 5);
    }
}

/// A mover that crosses the picture and goes, under a sun and a spot, each of whose shadows comes and goes.
Scene crossing_scene() {
    Scene scene = made::scene_of({box_mesh({-0.2, 0.3, -0.2}, {0.2, 0.6, 0.2}), made::ground(0, 9)});
    scene.meshes[0].mover = 0;
    return scene;
}

SceneState crossing_state(double t) {
    SceneState state;
    state.camera = camera_looking_at({0, 2.5, 2}, {0, 0, 0}, 30, 0.1, 40);
    state.light = directional_light({-90, 60}, 0.05);
    state.more_lights = {spot_light({0.8, 3, 0}, {0.8, 0, 0.01}, 0.05, 35)};
    glm::dmat4 mover(1);
    // Twice there and back, standing still at times.
    mover[3].x = 4 * std::sin(4 * std::numbers::pi * std::floor(t * 20) / 20);
    state.movers = {mover};
    return state;
}

TEST_F(ShadowQueries, ALightThatComesAndGoesIsDrawnTheSame) {
    const GpuScene gpu = upload(crossing_scene());
    const FrameTarget target = make_frame_target(Show::colour, kWidth, kHeight, 1);
    gl::PassTimer timer;
    for (const Method& method : {kMethods[1], kMethods[3], kMethods[5]}) {
        SCOPED_TRACE(method.technique);
        Asked asked(method, gpu, crossing_state(0));
        // Stored each frame: points on drawn surfaces are rounded otherwise.
        ShadowRenderer with(technique_named(method.technique),
                            settings_of(method, skips_without("needless-storing"), std::nullopt), gpu,
                            crossing_state(0), kAspect);
        ShadowRenderer without(
            technique_named(method.technique),
            settings_of(method, skips_without("needless-storing,hidden-shadows,unseen-shadows"), std::nullopt), gpu,
            crossing_state(0), kAspect);
        constexpr int kFrames = 60;
        int changes = 0;
        bool last = false;
        for (int frame = 0; frame < kFrames; ++frame) {
            const SceneState state = crossing_state(static_cast<double>(frame) / kFrames);
            SceneState sun = state;
            sun.more_lights.clear();
            const bool seen = asked.shown(gpu, sun, target_) == Shown::shadow;
            changes += frame > 0 && seen != last;
            last = seen;
            with.draw(gpu, state, target, timer);
            const Image picture = read_colour(target);
            without.draw(gpu, state, target, timer);
            EXPECT_EQ(picture.pixels, read_colour(target).pixels) << "frame " << frame;
            for (const size_t light : {0, 1}) {
                EXPECT_EQ(with.shadows()[light].map().shape.texel(), without.shadows()[light].map().shape.texel())
                    << "frame " << frame << " light " << light;
            }
        }
        EXPECT_GE(changes, 3);
    }
}

TEST(QueryPatience, SeenLightsAreAskedEverMoreSeldom) {
    QueryPatience patience;
    std::vector<int> asked;
    for (int frame = 0; frame < 70; ++frame) {
        if (!patience.is_due()) continue;
        asked.push_back(frame);
        patience.answered(Shown::shadow);
    }
    EXPECT_EQ(asked, (std::vector<int>{0, 2, 5, 10, 19, 36, 53}));
    patience.answered(Shown::light);
    for (int frame = 0; frame < 3; ++frame) {
        EXPECT_TRUE(patience.is_due());
        patience.answered(Shown::nothing);
    }
}

TEST_F(ShadowQueries, BoxesHoldAllCastersAndAreFew) {
    Scene scene;
    scene.materials.emplace_back();
    for (int i = 0; i < 300; ++i) {
        const auto x = static_cast<float>(i);
        scene.meshes.push_back(made::polygon({{x, 0, 0}, {x + 0.5f, 1, 0}, {x, 0, 2}}, true));
    }
    scene.meshes.push_back(made::ground(0, 9));
    EXPECT_EQ(caster_boxes(upload(scene)).size(), 100u);
    for (int i = 0; i < 10; ++i) scene.meshes[30 * i].mover = i;
    const std::vector<CasterBox> boxes = caster_boxes(upload(scene));
    EXPECT_LE(boxes.size(), kMostCasterBoxes);
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.casts) continue;
        EXPECT_TRUE(std::any_of(boxes.begin(), boxes.end(), [&](const CasterBox& box) {
            return box.mover == mesh.mover &&
                   std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vertex& vertex) {
                       const glm::dvec3 point(vertex.position);
                       return glm::all(glm::lessThanEqual(box.bounds.low, point)) &&
                              glm::all(glm::lessThanEqual(point, box.bounds.high));
                   });
        }));
    }
}

}  // namespace
}  // namespace stairstep
