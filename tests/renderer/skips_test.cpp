// What frames leave out isn't seen: pictures with all skips, with none and without each alone are the same, over sequences of
// frames in which all that can move moves, and stands still in between.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "renderer/gl/context.h"
#include "renderer/scenes/scenes.h"
#include "renderer/shadow_renderer.h"
#include "renderer/techniques/techniques.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr const char* kTruck = "/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf";
constexpr int kWidth = 160;
constexpr int kHeight = 90;
constexpr double kAspect = static_cast<double>(kWidth) / kHeight;
/// Frames of the same state: the first of a change, the one that is kept, and one that shows what was kept.
constexpr int kFramesOfAState = 3;
/// Stored surfaces lie where a ray meets a plane, drawn ones where a rasteriser interpolates, and both are rounded: a filter that
/// begins or ends right at a caster's edge may fall on its other side. Where a solid's outline passes through a pixel's centre, to the
/// 1/256 px that corners are rounded to, its back face may come out before its front. How many of the 14,400 pixels may differ by more
/// than a level.
int most_others(const std::string& scene) {
    // A million triangles: outlines are everywhere.
    return scene == "city" ? 20 : 5;
}

struct Method {
    const char* technique;
    FilterMode filter;
    std::optional<int> fixed_size;
};

constexpr Method kMethods[]{
    {"pcf", FilterMode::exact, 300}, {"pcf", FilterMode::automatic, {}}, {"pcss", FilterMode::automatic, {}}};

/// All motions, one after the other.
std::vector<SceneState> states_of(const AnimatedScene& animated) {
    std::vector<SceneState> states;
    for (const Motion motion : {Motion::still, Motion::caster, Motion::light, Motion::camera}) {
        for (const double t : {0.3, 0.7}) {
            if (motion == Motion::still && t > 0.3) continue;
            for (int i = 0; i < kFramesOfAState; ++i) {
                states.push_back(animated.state(motion, t));
            }
        }
    }
    return states;
}

/// A renderer with a picture of its own.
class Film {
  public:
    Film(const AnimatedScene& animated, const GpuScene& gpu, const Method& method, const Skips& skips)
        : gpu_(gpu),
          renderer_(technique_named(method.technique), settings(animated, method, skips), gpu,
                    animated.state(Motion::still, 0), kAspect) {}

    std::vector<uint8_t> draw(const SceneState& state) {
        renderer_.draw(gpu_, state, target_, timer_);
        return read_colour(target_).pixels;
    }
    glm::ivec2 size() const { return {renderer_.map().shape.width, renderer_.map().shape.height}; }

  private:
    static ShadowSettings settings(const AnimatedScene& animated, const Method& method, const Skips& skips) {
        ShadowSettings settings;
        settings.technique.filter = method.filter;
        settings.radius = animated.radius;
        settings.fixed_size = method.fixed_size;
        settings.largest_size = 2048;
        settings.skips = skips;
        return settings;
    }

    const GpuScene& gpu_;
    FrameTarget target_ = make_frame_target(Show::colour, kWidth, kHeight, 1);
    ShadowRenderer renderer_;
    gl::PassTimer timer_;
};

class SkipsOf : public testing::TestWithParam<const char*> {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
    const AnimatedScene animated_ =
        std::string(GetParam()) == "truck" ? load_animated_scene(kTruck) : scene_named(GetParam());
    const GpuScene gpu_ = upload(animated_.scene);
};

TEST_P(SkipsOf, AllOfThemAreUnseen) {
    for (const Method& method : kMethods) {
        SCOPED_TRACE(testing::Message() << method.technique << " " << name(method.filter));
        Film with(animated_, gpu_, method, {});
        Film without(animated_, gpu_, method, skips_without("all"));
        int frame = 0;
        std::vector<uint8_t> last;
        int changes = 0;
        for (const SceneState& state : states_of(animated_)) {
            const std::vector<uint8_t> picture = with.draw(state);
            const int differing = made::pixels_apart(picture, without.draw(state));
            EXPECT_LE(differing, most_others(animated_.name)) << "frame " << frame;
            EXPECT_EQ(with.size(), without.size()) << "frame " << frame;
            changes += picture != last;
            last = picture;
            ++frame;
        }
        EXPECT_GE(changes, 7) << "nothing to see";
    }
}

TEST_P(SkipsOf, EachAloneIsUnseen) {
    const Method& method = kMethods[2];
    Film with(animated_, gpu_, method, {});
    std::vector<std::unique_ptr<Film>> withouts;
    for (const SkipName& skip : kSkips) {
        withouts.push_back(std::make_unique<Film>(animated_, gpu_, method, skips_without(std::string(skip.name))));
    }
    int frame = 0;
    for (const SceneState& state : states_of(animated_)) {
        const std::vector<uint8_t> picture = with.draw(state);
        for (size_t i = 0; i < withouts.size(); ++i) {
            const int differing = made::pixels_apart(picture, withouts[i]->draw(state));
            EXPECT_LE(differing, most_others(animated_.name)) << "frame " << frame << " " << kSkips[i].name;
        }
        ++frame;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SkipsOf,
                         testing::Values("crane", "colonnade", "clutter", "cornell", "fence", "rooms", "city", "truck"),
                         [](const auto& param) { return std::string(param.param); });

}  // namespace
}  // namespace stairstep
