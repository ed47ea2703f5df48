// Scenes, maps, pictures and radii at the end of what there can be: no GL error, no NaN, and the light where it must be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/gl/context.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

class ExtremeShadow : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

/// Of a box's share.
constexpr double kRounding = 1e-4;

struct Case {
    const char* technique;
    FilterMode filter;
    std::optional<int> size;
    Light light;
};

/// Every technique, filter, way of sizing and kind of light.
std::vector<Case> all_cases() {
    std::vector<Case> cases;
    const Light sun = directional_light({30, 60}, 0.1);
    const Light spot = spot_light({1, 4, 1}, {0, 0, 0}, 0.2, 60);
    for (const Light& light : {sun, spot}) {
        for (const std::optional<int> size : {std::optional<int>(), std::optional<int>(1), std::optional<int>(64)}) {
            cases.push_back({"none", FilterMode::automatic, size, light});
            for (const char* technique : {"hard", "vsm", "esm"}) {
                cases.push_back({technique, FilterMode::automatic, size, light});
            }
            for (const char* technique : {"pcf", "pcss"}) {
                for (const FilterMode filter : {FilterMode::exact, FilterMode::jittered, FilterMode::rotated}) {
                    cases.push_back({technique, filter, size, light});
                }
            }
        }
    }
    return cases;
}

bool is_prefiltered(const Case& c) {
    return std::string(c.technique) == "vsm" || std::string(c.technique) == "esm";
}

/// An exact filter refuses to cover over 128 texels (shadow_test.cpp), as any does of a map of fixed size that was fitted to
/// nothing.
bool may_refuse(const Case& c) {
    return std::string(c.technique) == "pcf" && c.filter == FilterMode::exact && c.size;
}

std::string described(const Case& c) {
    return std::string(c.technique) + " " + std::string(name(c.filter)) + " " + std::to_string(c.size.value_or(0)) +
           (c.light.kind == Light::Kind::spot ? " spot" : " sun");
}

struct Picture {
    int width = 40;
    int height = 30;
};

/// Two frames of each, the second in colour. Throws on any GL error.
std::vector<float> draw(const Scene& scene, const Case& c, double radius, const Camera& camera, const Picture& size) {
    const GpuScene gpu = upload(scene);
    ShadowSettings settings;
    settings.technique.filter = c.filter;
    settings.radius = radius;
    settings.fixed_size = c.size;
    settings.largest_size = 256;
    const SceneState state{camera, c.light, {}};
    ShadowRenderer renderer(technique_named(c.technique), settings, gpu, state,
                            static_cast<double>(size.width) / size.height);
    gl::PassTimer timer;
    const FrameTarget target = make_frame_target(Show::visibility, size.width, size.height, 1);
    renderer.draw(gpu, state, target, timer);
    renderer.draw(gpu, state, make_frame_target(Show::colour, size.width, size.height, 1), timer);
    std::vector<float> values = read_visibility(target);
    for (const float value : values) EXPECT_TRUE(value >= 0 && value <= 1) << value;
    return values;
}

const Camera kCamera = made::camera_down({0, 3, 0});

TEST_F(ExtremeShadow, NothingToCastLeavesAllLit) {
    Mesh flat = made::polygon({{-1, 0.5f, 0}, {0, 0.5f, 0}, {1, 0.5f, 0}}, true);
    flat.indices.insert(flat.indices.end(), {0, 0, 0, 1, 1, 2});
    const Mesh point = made::polygon({{0.3f, 0.4f, 0.2f}, {0.3f, 0.4f, 0.2f}, {0.3f, 0.4f, 0.2f}}, true);
    for (const Case& c : all_cases()) {
        if (may_refuse(c)) continue;
        SCOPED_TRACE(described(c));
        for (const Scene& scene :
             {Scene{}, made::scene_of({}), made::scene_of({Mesh{}}), made::scene_of({made::ground(0, 9)}),
              made::scene_of({flat, made::ground(0, 9)}), made::scene_of({point, Mesh{}, made::ground(0, 9)})}) {
            const std::vector<float> values = draw(scene, c, 0.1, kCamera, {});
            EXPECT_GE(*std::min_element(values.begin(), values.end()), 1 - kRounding);
        }
    }
}

/// A sheet that shades all that is seen, and one that shades nothing of it.
Mesh sheet(float x, float half_side) {
    return made::polygon({{x - half_side, 3.3f, -half_side},
                          {x - half_side, 3.3f, half_side},
                          {x + half_side, 3.3f, half_side},
                          {x + half_side, 3.3f, -half_side}},
                         true);
}

TEST_F(ExtremeShadow, PicturesOfAPixelAreLitOrDark) {
    for (const Case& c : all_cases()) {
        SCOPED_TRACE(described(c));
        for (const Picture& size : {Picture{1, 1}, Picture{1, 7}, Picture{3, 1}}) {
            const bool shadows = std::string(c.technique) != "none";
            // A texel's width, which filters of soft shadows have at least, reaches beyond a map of one; so do pixels as large
            // as the map, which prefiltered ones are averaged over.
            const bool beyond = (std::string(c.technique) == "pcss" && c.size == 1) || is_prefiltered(c);
            for (const float value : draw(made::scene_of({sheet(0, 80), made::ground(0, 40)}), c, 0.01,
                                          made::camera_at({0, 3, 0}, {0, 90}), size)) {
                if (!beyond) {
                    EXPECT_NEAR(value, shadows ? 0 : 1, kRounding);
                }
            }
            if (may_refuse(c)) continue;
            for (const float value :
                 draw(made::scene_of({sheet(200, 80), made::ground(0, 40)}), c, 0.01, kCamera, size)) {
                EXPECT_NEAR(value, 1, kRounding);
            }
        }
    }
}

// A filter far wider than the scene averages over mostly nothing; one far below a texel is the texel's own edge.
TEST_F(ExtremeShadow, RadiiOfAnySizeAreFiltered) {
    const Scene scene = made::scene_of({sheet(0, 0.5f), made::ground(0, 9)});
    for (const Case& c : all_cases()) {
        if (std::string(c.technique) != "pcf" && !is_prefiltered(c)) continue;
        SCOPED_TRACE(described(c));
        for (const double radius : {1e-12, 1e-4, 1e4, 1e9}) {
            if (may_refuse(c) && radius > 1) continue;
            const std::vector<float> values = draw(scene, c, radius, kCamera, {});
            if (radius > 1 && (c.filter == FilterMode::exact || is_prefiltered(c))) {
                EXPECT_GT(*std::min_element(values.begin(), values.end()), 0.999);
            }
        }
    }
}

// Penumbras far wider than the scene, and light of no size.
TEST_F(ExtremeShadow, LightsOfAnySizeShine) {
    const Scene scene = made::scene_of({sheet(0, 0.5f), made::ground(0, 9)});
    for (Case c : all_cases()) {
        if (std::string(c.technique) != "pcss") continue;
        for (const double half_side : {0.0, 1e-9, 1e3, 1e7}) {
            SCOPED_TRACE(testing::Message() << described(c) << " half side " << half_side);
            c.light.half_side = half_side;
            const std::vector<float> values = draw(scene, c, 0.1, kCamera, {});
            if (half_side > 1 && c.filter == FilterMode::exact) {
                EXPECT_GT(*std::min_element(values.begin(), values.end()), 0.99);
            }
        }
    }
}

// Triangles without area among others change nothing but pixels at their own rims.
TEST_F(ExtremeShadow, TrianglesWithoutAreaCastNothing) {
    Mesh spiked = sheet(0, 0.5f);
    const auto first = static_cast<uint32_t>(spiked.vertices.size());
    for (const glm::vec3& corner : {glm::vec3(-0.4f, 3.3f, -0.4f), {0, 3.3f, 0}, {0.4f, 3.3f, 0.4f}}) {
        spiked.vertices.push_back({corner, {0, 1, 0}, {0, 0}});
    }
    spiked.indices.insert(spiked.indices.end(), {first, first + 1, first + 2, first, first, first});
    const Scene with = made::scene_of({spiked, made::ground(0, 9)});
    const Scene without = made::scene_of({sheet(0, 0.5f), made::ground(0, 9)});
    for (const Case& c : all_cases()) {
        SCOPED_TRACE(described(c));
        EXPECT_EQ(draw(with, c, 0.1, kCamera, {}), draw(without, c, 0.1, kCamera, {}));
    }
}

}  // namespace
}  // namespace stairstep
