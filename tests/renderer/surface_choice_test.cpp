// Storing surfaces or lighting them as they are drawn: which is cheaper by the counts, and that frames do it, unseen.
#include "renderer/surface_choice.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "renderer/gl/context.h"
#include "renderer/scenes/scenes.h"
#include "renderer/shadow_renderer.h"
#include "renderer/techniques/techniques.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep {
namespace {

constexpr double kPixels = 900'000;

double ratio(const SurfaceCounts& counts, const std::vector<double>& costs) {
    return drawn_over_stored(counts, costs);
}

TEST(DrawnOverStored, HasTheHeadersAnchors) {
    EXPECT_NEAR(ratio({kPixels, kPixels, 0}, {1.3}), 1.3 / 3.55, 1e-12);
    EXPECT_NEAR(ratio({2 * kPixels, kPixels, 0}, {10}), 20 / 13.25, 1e-12);
    // As many triangles as fragments: 6 idle lanes to each.
    EXPECT_NEAR(ratio({kPixels, kPixels, kPixels}, {10}), 70 / 18.25, 1e-12);
    // The second of two lights that sees all again: as drawn, it sets up a triangle at 10 for 100 pixels.
    EXPECT_NEAR(ratio({kPixels, kPixels, kPixels / 100}, {2, 3}), (1.6 * 5 + 0.1) / (1.6 + 2 * 1.25 + 5), 1e-12);
}

TEST(DrawnOverStored, IsOneWhereNothingIsSeen) {
    EXPECT_EQ(ratio({0, 0, 0}, {5}), 1);
    EXPECT_EQ(ratio({0, 0, 1000}, {5, 5}), 1);
}

/// Pictures of any size, layers, triangles, and lighting.
struct Made {
    SurfaceCounts counts;
    double cost = 0;
};

Made made_counts() {
    const double pixels = *rc::gen::inRange(1, 10'000'000);
    const double layers = 1 + 0.01 * *rc::gen::inRange(0, 2000);
    const double triangles = *rc::gen::inRange(0, 3'000'000);
    const double cost = 0.01 * *rc::gen::inRange(1, 10'000);
    return {{layers * pixels, pixels, triangles}, cost};
}

RC_GTEST_PROP(DrawnOverStored, RisesWithAllButThePixelsThatAreSeen, ()) {
    const auto [counts, cost] = made_counts();
    const double before = ratio(counts, {cost});
    const double factor = 1 + 0.01 * *rc::gen::inRange(1, 500);
    SurfaceCounts more = counts;
    more.fragments *= factor;
    RC_ASSERT(ratio(more, {cost}) >= before * (1 - 1e-12));
    more = counts;
    more.triangles *= factor;
    RC_ASSERT(ratio(more, {cost}) >= before * (1 - 1e-12));
    more = counts;
    more.pixels = std::min(factor * more.pixels, more.fragments);
    RC_ASSERT(ratio(more, {cost}) <= before * (1 + 1e-12));
    RC_ASSERT(ratio(counts, {factor * cost}) > before);
}

RC_GTEST_PROP(DrawnOverStored, DependsOnProportionsAlone, ()) {
    const auto [counts, cost] = made_counts();
    const double factor = *rc::gen::inRange(2, 100);
    const SurfaceCounts larger{factor * counts.fragments, factor * counts.pixels, factor * counts.triangles};
    RC_ASSERT(std::abs(ratio(larger, {cost, cost}) / ratio(counts, {cost, cost}) - 1) < 1e-9);
}

SurfaceChoice after(const SurfaceChoice& last, const SurfaceCounts& counts, double cost, bool must = false) {
    SurfaceChoice counted = last;
    counted.counts = counts;
    return choose_surfaces(counted, std::vector{cost}, must);
}

TEST(ChooseSurfaces, StoresUntilSomethingIsCounted) {
    SurfaceChoice choice;
    for (int i = 0; i < 3; ++i) {
        choice = choose_surfaces(choice, std::vector{1.3}, false);
        EXPECT_TRUE(choice.stored);
    }
}

TEST(ChooseSurfaces, DrawsWhatIsCheapAndStoresWhatHides) {
    const SurfaceChoice drawn = after({}, {kPixels, kPixels, 1000}, 1.3);
    EXPECT_FALSE(drawn.stored);
    EXPECT_TRUE(after(drawn, {3 * kPixels, kPixels, 1000}, 10).stored);
    EXPECT_TRUE(after({}, {3 * kPixels, kPixels, 1000}, 10).stored);
}

TEST(ChooseSurfaces, StoresWhereItMustAndForgetsIt) {
    const SurfaceChoice must = after({}, {kPixels, kPixels, 1000}, 1.3, true);
    EXPECT_TRUE(must.stored);
    EXPECT_FALSE(must.storing_pays);
    EXPECT_FALSE(after(must, {kPixels, kPixels, 1000}, 1.3).stored);
}

TEST(ChooseSurfaces, CountsAnewAfterMostDrawnFrames) {
    SurfaceChoice choice = after({}, {kPixels, kPixels, 1000}, 1.3, true);
    for (int round = 0; round < 3; ++round) {
        for (int i = 0; i < kMostDrawnFrames; ++i) {
            choice = choose_surfaces(choice, std::vector{1.3}, false);
            EXPECT_FALSE(choice.stored) << i;
        }
        choice = choose_surfaces(choice, std::vector{1.3}, false);
        EXPECT_TRUE(choice.stored);
    }
}

RC_GTEST_PROP(ChooseSurfaces, ChangesOnlyWhereItPaysATenth, ()) {
    const auto [counts, cost] = made_counts();
    const double drawn_over = ratio(counts, {cost});
    SurfaceChoice before;
    before.storing_pays = *rc::gen::arbitrary<bool>();
    const SurfaceChoice next = after(before, counts, cost);
    RC_ASSERT(next.stored == next.storing_pays);
    if (drawn_over > 1.1001) RC_ASSERT(next.stored);
    if (drawn_over < 0.909) RC_ASSERT(!next.stored);
    if (drawn_over > 0.9092 && drawn_over < 1.0999) RC_ASSERT(next.stored == before.storing_pays);
    // And stays there.
    RC_ASSERT(after(next, counts, cost).stored == next.stored);
}

constexpr int kWidth = 480;
constexpr int kHeight = 270;
constexpr double kAspect = static_cast<double>(kWidth) / kHeight;
/// As in skips_test.cpp: how many pixels on outlines of casters may differ by more than a level.
constexpr int kMostOthers = 45;

ShadowSettings settings_of(const AnimatedScene& animated, const Skips& skips) {
    ShadowSettings settings;
    settings.radius = animated.radius;
    settings.largest_size = 2048;
    settings.skips = skips;
    return settings;
}

/// A renderer with a picture of its own.
struct Film {
    Film(const AnimatedScene& animated, const GpuScene& gpu, const char* technique, const Skips& skips)
        : gpu(gpu),
          renderer(technique_named(technique), settings_of(animated, skips), gpu, animated.state(Motion::still, 0),
                   kAspect) {}

    FrameTime draw(const SceneState& state) { return renderer.draw(gpu, state, target, timer); }
    std::vector<uint8_t> picture() const { return read_colour(target).pixels; }
    std::vector<float> needs() const {
        std::vector<float> needs(static_cast<size_t>(kWidth) * kHeight);
        gl::GetTextureImage(target.need.id(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(needs.size() * sizeof(float)),
                            needs.data());
        return needs;
    }

    const GpuScene& gpu;
    FrameTarget target = make_frame_target(Show::colour, kWidth, kHeight, 1);
    ShadowRenderer renderer;
    gl::PassTimer timer;
};

struct Case {
    const char* scene;
    const char* technique;
    bool stores;
};

void PrintTo(const Case& one, std::ostream* out) {
    *out << one.scene << " " << one.technique;
}

class ChoiceIn : public testing::TestWithParam<Case> {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
    const AnimatedScene animated_ = scene_named(GetParam().scene);
    const GpuScene gpu_ = upload(animated_.scene);

    SceneState frame(int i) const { return animated_.state(Motion::caster, 0.02 * i); }
};

TEST_P(ChoiceIn, SettlesOnWhatIsCheaper) {
    Film film(animated_, gpu_, GetParam().technique, {});
    int stored = 0;
    constexpr int kFrames = 12;
    for (int i = 0; i < kFrames; ++i) stored += film.draw(frame(i)).stored;
    if (GetParam().stores) {
        EXPECT_EQ(stored, kFrames);
    } else {
        // The first, and those that are asked what they show.
        EXPECT_LE(stored, 5);
        EXPECT_GE(stored, 1);
    }
}

TEST_P(ChoiceIn, IsUnseen) {
    Film film(animated_, gpu_, GetParam().technique, {});
    Film always_drawn(animated_, gpu_, GetParam().technique, skips_without("hidden-surfaces"));
    std::vector<uint8_t> last;
    for (int i = 0; i < 9; ++i) {
        // The last three are the same.
        const SceneState state = frame(std::min(i, 6));
        film.draw(state);
        EXPECT_FALSE(always_drawn.draw(state).stored);
        EXPECT_LE(made::pixels_apart(film.picture(), always_drawn.picture()), kMostOthers) << "frame " << i;
        EXPECT_EQ(film.renderer.map().shape.width, always_drawn.renderer.map().shape.width) << "frame " << i;
    }
}

TEST_P(ChoiceIn, IsTheSameEachTime) {
    Film one(animated_, gpu_, GetParam().technique, {});
    Film other(animated_, gpu_, GetParam().technique, {});
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(one.draw(frame(i)).stored, other.draw(frame(i)).stored) << "frame " << i;
        EXPECT_EQ(one.picture(), other.picture()) << "frame " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ChoiceIn,
                         testing::Values(Case{"crane", "none", false}, Case{"crane", "hard", false},
                                         Case{"cornell", "pcss", false}, Case{"clutter", "pcf", true},
                                         Case{"clutter", "pcss", true}),
                         [](const auto& one) { return std::string(one.param.scene) + "_" + one.param.technique; });

class Choice : public testing::Test {
  protected:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

// Drawn frames don't keep visibility, which the same pixels need: they are stored then.
TEST_F(Choice, StillPicturesEndInKeptVisibility) {
    const AnimatedScene animated = scene_named("cornell");
    const GpuScene gpu = upload(animated.scene);
    Film film(animated, gpu, "pcss", {});
    bool drawn = false;
    for (int i = 0; i < 8; ++i) drawn = !film.draw(animated.state(Motion::caster, 0.05 * i)).stored || drawn;
    EXPECT_TRUE(drawn);
    // Sizes settle first.
    const SceneState still = animated.state(Motion::caster, 0.35);
    for (int i = 0; i < 4; ++i) film.draw(still);
    const std::vector<uint8_t> first = film.picture();
    for (int i = 0; i < 3; ++i) {
        const FrameTime time = film.draw(still);
        EXPECT_TRUE(time.stored) << i;
        // What is kept isn't measured again.
        EXPECT_EQ(time.need.cpu_ms, 0) << i;
        EXPECT_GT(time.surfaces.cpu_ms, 0) << i;
        EXPECT_EQ(film.picture(), first) << i;
    }
    // It moves on: drawn again, and measured.
    bool measured_drawn = false;
    for (int i = 0; i < 4; ++i) {
        const FrameTime time = film.draw(animated.state(Motion::caster, 0.5 + 0.05 * i));
        EXPECT_GT(time.need.cpu_ms, 0) << i;
        if (time.stored) continue;
        EXPECT_EQ(time.surfaces.cpu_ms, 0) << i;
        measured_drawn = true;
    }
    EXPECT_TRUE(measured_drawn);
}

// Of surfaces that are lit as they are drawn, those that nearer ones cover leave nothing behind.
TEST_F(Choice, NeedsAreThoseOfTheNearestSurfaces) {
    const AnimatedScene animated = scene_named("clutter");
    const GpuScene gpu = upload(animated.scene);
    Film stored(animated, gpu, "pcss", {});
    Film drawn(animated, gpu, "pcss", skips_without("hidden-surfaces,overdraw"));
    const SceneState state = animated.state(Motion::still, 0);
    EXPECT_TRUE(stored.draw(state).stored);
    EXPECT_FALSE(drawn.draw(state).stored);
    const std::vector<float> wanted = stored.needs();
    const std::vector<float> found = drawn.needs();
    int differing = 0;
    int needing = 0;
    for (size_t i = 0; i < wanted.size(); ++i) {
        needing += wanted[i] < 1e30f;
        differing += std::abs(found[i] - wanted[i]) > 0.01f * wanted[i];
    }
    EXPECT_GT(needing, kWidth * kHeight / 20);
    EXPECT_LE(differing, kMostOthers);
}

// Pictures of which nothing is asked are counted all the same.
TEST_F(Choice, CountsAnewWhereNothingElseDoes) {
    const AnimatedScene animated = scene_named("cornell");
    const GpuScene gpu = upload(animated.scene);
    Film film(animated, gpu, "none", {});
    for (int i = 0; i < 2 * (kMostDrawnFrames + 1) + 1; ++i) {
        EXPECT_EQ(film.draw(animated.state(Motion::caster, 0.01 * i)).stored, i % (kMostDrawnFrames + 1) == 0) << i;
    }
}

}  // namespace
}  // namespace stairstep
