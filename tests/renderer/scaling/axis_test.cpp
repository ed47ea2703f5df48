// Axes: what they are called, what their values span, and that each changes one thing.
#include "renderer/scaling/axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "renderer/scaling/box_field.h"
#include "stimuli/error.h"

namespace stairstep::scaling {
namespace {

std::vector<double> things_of(const Scenario& s) {
    return {static_cast<double>(s.cells),
            static_cast<double>(s.width),
            static_cast<double>(s.height),
            s.radius,
            s.half_tangent,
            static_cast<double>(s.lights)};
}

TEST(Axes, SpanWhatTheirCurvesAreAbout) {
    const std::map<std::string, std::pair<double, double>> ends{{"triangles", {1e3, 1e6}},
                                                                {"height", {480, 2160}},
                                                                {"radius", {0.1, 1.6}},
                                                                {"lights", {1, 16}},
                                                                {"light-size", {0.003, 0.3}}};
    for (const Axis& axis : axes()) {
        ASSERT_TRUE(ends.contains(axis.name)) << axis.name;
        EXPECT_EQ(axis.values.front(), ends.at(axis.name).first) << axis.name;
        EXPECT_EQ(axis.values.back(), ends.at(axis.name).second) << axis.name;
    }
}

TEST(Axes, ValuesAscendAndAreWhatIsDrawn) {
    for (const Axis& axis : axes()) {
        for (const std::vector<double>& values : {axis.values, axis.quick_values}) {
            ASSERT_GE(values.size(), 3u) << axis.name << ": an exponent's standard error takes three";
            double last = 0;
            for (const double value : values) {
                Scenario scenario;
                const double reached = axis.apply(scenario, value);
                EXPECT_GT(reached, last) << axis.name;
                EXPECT_NEAR(reached / value, 1, 0.15) << axis.name << ": the nearest that there is";
                last = reached;
            }
        }
    }
}

TEST(Axes, ChangeOneThing) {
    for (const Axis& axis : axes()) {
        Scenario low, high;
        axis.apply(low, axis.values.front());
        axis.apply(high, axis.values.back());
        const std::vector<double> a = things_of(low), b = things_of(high);
        int changed = 0;
        for (size_t i = 0; i < a.size(); ++i) changed += a[i] != b[i];
        EXPECT_EQ(changed, axis.name == "height" ? 2 : 1) << axis.name;
    }
}

TEST(Axes, PicturesHaveTheUsualWidths) {
    const std::map<double, int> widths{{480, 854}, {720, 1280}, {1080, 1920}, {1440, 2560}, {2160, 3840}};
    for (const double height : axis_named("height").values) {
        Scenario scenario;
        axis_named("height").apply(scenario, height);
        EXPECT_EQ(scenario.height, height);
        EXPECT_EQ(scenario.width, widths.at(height));
    }
}

TEST(Axes, LightsAreThereAndApart) {
    Scenario scenario;
    axis_named("lights").apply(scenario, 16);
    const SceneState state = state_of(scenario);
    ASSERT_EQ(state.more_lights.size(), 15u);
    std::vector<Light> lights = state.more_lights;
    lights.push_back(state.light);
    for (size_t i = 0; i < lights.size(); ++i) {
        EXPECT_DOUBLE_EQ(lights[i].half_tangent(), scenario.half_tangent);
        EXPECT_NEAR(lights[i].basis.back.y, state.light.basis.back.y, 1e-12) << "equally high";
        for (size_t j = 0; j < i; ++j) EXPECT_LT(glm::dot(lights[i].basis.back, lights[j].basis.back), 0.999);
    }
}

TEST(Axes, TakeTheTechniquesThatDependOnThem) {
    const auto names_on = [](const std::string& axis) {
        std::vector<std::string> names;
        for (const auto& one : techniques_on(axis_named(axis), all_techniques())) names.push_back(label(one));
        return names;
    };
    EXPECT_EQ(names_on("height").size(), all_techniques().size());
    EXPECT_EQ(names_on("radius"),
              (std::vector<std::string>{"none", "hard auto", "pcf-exact auto", "pcf-rotated 4096, 25 taps"}));
    EXPECT_EQ(names_on("light-size"), (std::vector<std::string>{"none", "pcss-levels auto", "pcss 4096, 25+25 taps"}));
}

TEST(Axes, UnknownNamesAreRefusedWithThoseThereAre) {
    try {
        axis_named("colour");
        ADD_FAILURE();
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("light-size"), std::string::npos) << e.what();
    }
}

}  // namespace
}  // namespace stairstep::scaling
