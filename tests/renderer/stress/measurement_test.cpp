// What the renderer does under stress, in a quick subset of conditions, and whether the measures would notice if it failed.
#include "renderer/stress/measurement.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "renderer/gl/context.h"
#include "renderer/techniques/techniques.h"

namespace stairstep::stress {
namespace {

class Stress : public testing::Test {
  protected:
    Measurement under(const Condition& condition, const std::string& technique) const {
        const std::vector<float> truth = true_visibility(
            condition.stage, truth_for(technique), light_plane_radius(condition), settings_.width, settings_.height);
        return measure(condition, technique_named(technique), settings_, truth);
    }

    static Condition named(const std::string& what, const std::string& value) {
        for (const Condition& condition : all_conditions(false, false)) {
            if (condition.what == what && condition.value == value) return condition;
        }
        ADD_FAILURE() << "no condition " << what << " " << value;
        return {};
    }

    const MeasurementSettings settings_{80, 45, 1024};

  private:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

constexpr std::array kTechniques{"hard", "pcf", "pcss", "vsm", "esm"};

TEST_F(Stress, LeavesNoNanAndNoErrorOfGl) {
    for (const Condition& condition : all_conditions(true, false)) {
        for (const char* technique : kTechniques) {
            SCOPED_TRACE(condition.what + " " + condition.value + " " + technique);
            const Measurement one = under(condition, technique);
            EXPECT_EQ(one.nan_pixels, 0u);
            EXPECT_EQ(one.gl_errors, 0u);
            EXPECT_EQ(one.failure, "");
            // A filter of no width has no size by the law.
            EXPECT_EQ(one.refusal.empty(), condition.radius > 0 || condition.fixed_size) << one.refusal;
        }
    }
}

// Exact comparisons with the receiver's own plane leave no acne wherever light comes at more than 3° (steeper planes are
// flattened, receiver.glsl).
TEST_F(Stress, LeavesNoAcneWhereComparisonsAreExact) {
    for (const Condition& condition : all_conditions(true, false)) {
        if (condition.course != Course::picture || condition.value == "0.1°" || condition.stage.boxes.empty()) continue;
        for (const char* technique : {"hard", "pcf"}) {
            SCOPED_TRACE(condition.what + " " + condition.value + " " + technique);
            EXPECT_EQ(under(condition, technique).acne_share.value_or(0), 0);
        }
    }
    const Measurement plain = under(named("nothing", "as it is"), "pcf");
    ASSERT_TRUE(plain.acne_share && plain.detachment_texels);
    EXPECT_LT(*plain.detachment_texels, 0.1);
}

// Where a scene stands and how large it is changes its map's phase and nothing else.
TEST_F(Stress, HoldsAtAnyPlaceAndScale) {
    for (const char* technique : {"pcf", "pcss"}) {
        const double plain = under(named("nothing", "as it is"), technique).error_rmse;
        for (const auto& [what, value] : {std::pair("world offset", "1e6"),
                                          {"scale", "1e-3"},
                                          {"scale", "1e4"},
                                          {"triangles", "NaN corners"},
                                          {"triangles", "infinite corners"},
                                          {"triangles", "without area"},
                                          {"triangles", "all of them twice"}}) {
            SCOPED_TRACE(std::string(what) + " " + value + " " + technique);
            EXPECT_LT(under(named(what, value), technique).error_rmse, 2 * plain + 0.002);
        }
    }
}

// Triangles that have no place change nothing at all.
TEST_F(Stress, DrawsNothingOfWhatIsNotFinite) {
    for (const char* technique : kTechniques) {
        const double plain = under(named("nothing", "as it is"), technique).error_rmse;
        EXPECT_EQ(under(named("triangles", "NaN corners"), technique).error_rmse, plain);
        EXPECT_EQ(under(named("triangles", "infinite corners"), technique).error_rmse, plain);
    }
}

// A caster that the truth doesn't know of, far above, must show as acne and as an error.
TEST_F(Stress, MeasuresSeeAPlantedShadow) {
    Condition planted = named("nothing", "as it is");
    Mesh lid;
    lid.mover = 0;
    for (const glm::vec3& corner : {glm::vec3(-9, 9, -9), {-9, 9, 9}, {9, 9, 9}, {9, 9, -9}}) {
        lid.vertices.push_back({corner, {0, 1, 0}, {0, 0}});
    }
    lid.indices = {0, 1, 2, 0, 2, 3};
    planted.extra = {lid};
    const Measurement one = under(planted, "hard");
    ASSERT_TRUE(one.acne_share);
    EXPECT_GT(*one.acne_share, 0.5);
    EXPECT_GT(one.error_rmse, 0.5);
}

// A technique without shadows lights the whole strip along the contact, whose width is known, and has all of it wrong.
TEST_F(Stress, MeasuresSeeALostShadow) {
    const Measurement one = under(named("fixed map", "4096"), "none");
    ASSERT_TRUE(one.detachment_texels);
    EXPECT_NEAR(*one.detachment_texels, kContactTexels, 1e-3);
    EXPECT_EQ(one.acne_share, 0);
    EXPECT_EQ(one.error_max, 1);
}

TEST_F(Stress, CoursesEndAsTheyBegan) {
    for (const Condition& condition : all_conditions(true, false)) {
        if (condition.course == Course::picture) continue;
        for (const char* technique : kTechniques) {
            SCOPED_TRACE(condition.what + " " + technique);
            const Measurement one = under(condition, technique);
            ASSERT_TRUE(one.drift);
            EXPECT_EQ(*one.drift, 0);
            if (one.growth_kib) EXPECT_LT(*one.growth_kib, 8192);
        }
    }
}

TEST(Conditions, AreNamedOnceAndAllQuickOnesAreAmongThem) {
    std::map<std::pair<std::string, std::string>, int> all;
    for (const Condition& condition : all_conditions(false, false)) {
        EXPECT_EQ(++all[std::pair(condition.what, condition.value)], 1) << condition.what << " " << condition.value;
    }
    for (const Condition& condition : all_conditions(true, false)) {
        if (condition.course == Course::picture) EXPECT_EQ(all.count({condition.what, condition.value}), 1u);
    }
    EXPECT_EQ(swung(plain_stage(), 0).light.basis.back, swung(plain_stage(), kPeriod).light.basis.back);
    EXPECT_NE(swung(plain_stage(), 0).light.basis.back, swung(plain_stage(), kPeriod / 4).light.basis.back);
}

}  // namespace
}  // namespace stairstep::stress
