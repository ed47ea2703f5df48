// What the renderer does under stress, in a quick subset of conditions, and whether the measures would notice if it failed.
#include "renderer/stress/measurement.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "renderer/gl/context.h"
#include "renderer/stress/stress_table.h"
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

    const MeasurementSettings settings_{64, 36, 512};

  private:
    std::unique_ptr<gl::Context> context_ = gl::make_osmesa_context();
};

constexpr std::array kTechniques{"hard", "pcf", "pcss", "vsm", "esm"};

// Exact comparisons with the receiver's own plane leave no acne wherever light comes at more than 3° (steeper planes are
// flattened, receiver.glsl). Where a scene stands and how large it is changes its map's phase and nothing else, and triangles
// that have no place nothing at all.
TEST_F(Stress, HoldsUnderAllQuickConditions) {
    std::map<std::string, Measurement> plain;
    for (const char* technique : kTechniques) plain[technique] = under(named("nothing", "as it is"), technique);
    ASSERT_TRUE(plain["pcf"].acne_share && plain["pcf"].detachment_texels);
    EXPECT_LT(*plain["pcf"].detachment_texels, 0.1);
    for (const Condition& condition : all_conditions(true, false)) {
        if (condition.course != Course::picture || condition.what == "nothing") continue;
        for (const char* technique : kTechniques) {
            SCOPED_TRACE(condition.what + " " + condition.value + " " + technique);
            const Measurement one = under(condition, technique);
            EXPECT_EQ(one.nan_pixels, 0u);
            EXPECT_EQ(one.gl_errors, 0u);
            EXPECT_EQ(one.failure, "");
            // A filter of no width has no size by the law.
            EXPECT_EQ(one.refusal.empty(), condition.radius > 0 || condition.fixed_size) << one.refusal;
            const bool exact = std::string(technique) == "hard" || std::string(technique) == "pcf";
            EXPECT_TRUE(!exact || condition.value == "0.1°" || one.acne_share.value_or(0) == 0);
            if (condition.what == "world offset" || condition.what == "scale") {
                EXPECT_LT(one.error_rmse, 2 * plain[technique].error_rmse + 0.002);
            }
            if (condition.value == "NaN corners" || condition.value == "infinite corners") {
                EXPECT_EQ(one.error_rmse, plain[technique].error_rmse);
            }
        }
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
#ifndef __SANITIZE_ADDRESS__
            // The sanitizer keeps what was freed for a while.
            EXPECT_LT(one.growth_kib.value_or(0), 8192);
#endif
            EXPECT_EQ(one.nan_pixels, 0u);
            EXPECT_EQ(one.gl_errors, 0u);
        }
    }
}

TEST(Table, HasARowForValuesThatFareAlike) {
    Condition picture;
    picture.what = "light";
    Measurement fine;
    fine.technique = "hard";
    fine.error_rmse = 0.01;
    Measurement broken = fine;
    broken.acne_share = 0.125;
    broken.detachment_texels = 2;
    broken.nan_pixels = 3;
    Condition course;
    course.what = "frames";
    course.course = Course::frames;
    Measurement long_run = fine;
    long_run.drift = 0;
    long_run.growth_kib = 20;
    long_run.late_growth_kib = 4;
    std::vector<ConditionResult> results;
    const auto add = [&](Condition condition, const std::string& value, const Measurement& one) {
        condition.value = value;
        results.push_back({condition, {one}});
    };
    add(picture, "1", fine);
    add(course, "80", long_run);
    add(picture, "2", broken);
    add(picture, "3", fine);
    EXPECT_EQ(stress_table(results),
              "| condition | hard |\n|---|---|\n"
              "| light: 1; 3 | 0.0100 |\n"
              "| light: 2 | 0.0100, acne 12.50 %, gap 2.00, NaN 3 |\n"
              "| frames: 80 | drift 0.0000, 20 KiB (4) |\n");
}

TEST(Conditions, AreNamedOnceAndAllQuickOnesAreAmongThem) {
    std::map<std::pair<std::string, std::string>, int> all;
    for (const Condition& condition : all_conditions(false, false)) {
        EXPECT_EQ(++all[std::pair(condition.what, condition.value)], 1) << condition.what << " " << condition.value;
    }
    for (const Condition& condition : all_conditions(true, false)) {
        if (condition.course != Course::picture) continue;
        EXPECT_EQ(all.count({condition.what, condition.value}), 1u) << condition.what << " " << condition.value;
    }
    EXPECT_EQ(swung(plain_stage(), 0).light.basis.back, swung(plain_stage(), kPeriod).light.basis.back);
    EXPECT_NE(swung(plain_stage(), 0).light.basis.back, swung(plain_stage(), kPeriod / 4).light.basis.back);
}

}  // namespace
}  // namespace stairstep::stress
