#include "renderer/scaling/axis.h"

#include <algorithm>
#include <cmath>

#include "renderer/scaling/box_field.h"
#include "stimuli/error.h"

namespace stairstep::scaling {
namespace {

constexpr double kGoldenAngle_deg = 137.50776405003785;

double set_triangles(Scenario& scenario, double value) {
    scenario.cells = cells_for(value);
    return static_cast<double>(triangle_count(make_box_field(scenario.cells)));
}

double set_height(Scenario& scenario, double value) {
    scenario.height = static_cast<int>(value);
    // 16 : 9, even: 854 × 480 as is usual.
    scenario.width = 2 * static_cast<int>(std::lround(value * 8 / 9));
    return scenario.height;
}

double set_radius(Scenario& scenario, double value) {
    return scenario.radius = value;
}

double set_lights(Scenario& scenario, double value) {
    return scenario.lights = static_cast<int>(value);
}

double set_light_size(Scenario& scenario, double value) {
    return scenario.half_tangent = value;
}

const std::vector<Axis>& list() {
    const std::vector<std::string_view> all{"none", "hard", "pcf", "pcss"};
    static const std::vector<Axis> axes{
        {"triangles", "triangles", {1e3, 4e3, 1e4, 4e4, 1e5, 3e5, 1e6}, {1e3, 4e3, 1e4}, all, set_triangles},
        {"height", "height of the picture, px", {480, 720, 1080, 1440, 2160}, {180, 360, 720}, all, set_height},
        {"radius",
         "half-width of the filter, m",
         {0.1, 0.2, 0.4, 0.8, 1.6},
         {0.2, 0.4, 0.8},
         {"none", "hard", "pcf"},
         set_radius},
        {"lights", "lights", {1, 2, 4, 8, 16}, {1, 2, 4}, all, set_lights},
        {"light-size",
         "tangent of half the light's angle",
         {0.003, 0.01, 0.03, 0.1, 0.3},
         {0.01, 0.03, 0.1},
         {"none", "pcss"},
         set_light_size},
    };
    return axes;
}

}  // namespace

SceneState state_of(const Scenario& scenario) {
    constexpr double kElevation_deg = 48;
    SceneState state;
    state.camera = camera_looking_at({7, 13, 26}, {0, 0.5, 1}, 40, 1, 300);
    state.light = directional_light({-50, kElevation_deg}, scenario.half_tangent);
    for (int i = 1; i < scenario.lights; ++i) {
        state.more_lights.push_back(
            directional_light({-50 + kGoldenAngle_deg * i, kElevation_deg}, scenario.half_tangent));
    }
    return state;
}

std::span<const Axis> axes() {
    return list();
}

const Axis& axis_named(const std::string& name) {
    const auto found = std::ranges::find(list(), name, &Axis::name);
    if (found != list().end()) return *found;
    std::string names;
    for (const Axis& axis : list()) names += (names.empty() ? "" : ", ") + axis.name;
    throw InputError("axis \"" + name + "\"", "there is none of this name", "use one of " + names);
}

std::vector<bench::Configuration> all_techniques() {
    return {bench::without_shadows(), bench::auto_hard(), bench::auto_pcf(),
            bench::fixed_pcf(),       bench::auto_pcss(), bench::fixed_pcss()};
}

std::vector<bench::Configuration> techniques_on(const Axis& axis, const std::vector<bench::Configuration>& list) {
    std::vector<bench::Configuration> result;
    std::ranges::copy_if(list, std::back_inserter(result), [&](const bench::Configuration& one) {
        return std::ranges::find(axis.techniques, one.entry) != axis.techniques.end();
    });
    return result;
}

}  // namespace stairstep::scaling
