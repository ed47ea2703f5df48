// What the cost of shadows may grow with: axes, each of which changes one thing of a scenario and leaves the rest.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/bench/configuration.h"
#include "renderer/scene_state.h"

namespace stairstep::scaling {

/// What is drawn: a box field (box_field.h).
struct Scenario {
    int cells = 3;
    /// Of the picture, px.
    int width = 1280;
    int height = 720;
    /// Half-width of constant filters, world units.
    double radius = 0.3;
    /// Tangent of half the angle under which a light is seen.
    double half_tangent = 0.03;
    /// ≥ 1.
    int lights = 1;
};

/// The camera and the lights: the first from azimuth −50°, the others by the golden angle around from it, all equally high.
SceneState state_of(const Scenario& scenario);

struct Axis {
    /// As --axes knows it.
    std::string name;
    /// What a value is, with its unit.
    std::string quantity;
    /// Ascending, above 0, at least two.
    std::vector<double> values;
    /// Of a quick look.
    std::vector<double> quick_values;
    /// TechniqueEntry::name of those whose cost may depend on it.
    std::vector<std::string_view> techniques;
    /// Changes the scenario. Returns the value it has then, which is the nearest that there is.
    double (*apply)(Scenario& scenario, double value);
};

/// triangles, height, radius, lights, light-size.
std::span<const Axis> axes();

/// Throws InputError that lists the names there are.
const Axis& axis_named(const std::string& name);

/// none · hard auto · pcf-exact auto · pcf-rotated 4096, 25 taps · pcss-levels auto · pcss 4096, 25+25 taps.
std::vector<bench::Configuration> all_techniques();

/// Those of `list` that the axis bears on.
std::vector<bench::Configuration> techniques_on(const Axis& axis, const std::vector<bench::Configuration>& list);

}  // namespace stairstep::scaling
