#include "renderer/stress/conditions.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace stairstep::stress {
namespace {

/// Not along an axis, so that no coordinate is spared.
const glm::dvec3 kAway(1, 0.25, -0.6);

class List {
  public:
    explicit List(bool quick) : quick_(quick) {}

    /// Another one; `in_quick` says whether the short list has it.
    void add(Condition condition, bool in_quick) {
        if (in_quick || !quick_) conditions.push_back(std::move(condition));
    }

    std::vector<Condition> conditions;

  private:
    bool quick_;
};

Condition condition(const std::string& what, const std::string& value) {
    Condition made;
    made.what = what;
    made.value = value;
    return made;
}

void add_places(List& list) {
    list.add(condition("nothing", "as it is"), true);
    for (const auto& [value, offset] : {std::pair("1e2", 1e2), {"1e4", 1e4}, {"1e6", 1e6}}) {
        Condition made = condition("world offset", value);
        made.placement.offset = offset * kAway;
        list.add(made, offset == 1e6);
        made.what = "world offset, spot";
        made.stage = spot_stage();
        list.add(made, false);
    }
    for (const auto& [value, scale] : {std::pair("1e-3", 1e-3), {"1e2", 1e2}, {"1e4", 1e4}}) {
        Condition made = condition("scale", value);
        made.placement.scale = scale;
        list.add(made, scale == 1e-3 || scale == 1e4);
        made.what = "scale, spot";
        made.stage = spot_stage();
        list.add(made, false);
    }
    struct Range {
        const char* value;
        double near;
        double far;
    };
    for (const Range& range : {Range{"1e-3 … 60", 1e-3, 60},
                               {"0.1 … 1e6", 0.1, 1e6},
                               {"1e-3 … 1e6", 1e-3, 1e6},
                               {"4 … 6, cutting the scene", 4, 6}}) {
        Condition made = condition("camera near … far", range.value);
        made.stage.camera.near = range.near;
        made.stage.camera.far = range.far;
        list.add(made, range.near == 1e-3 && range.far == 1e6);
    }
}

void add_lights(List& list) {
    for (const auto& [value, elevation] : {std::pair("90°", 90.0),
                                           {"89.9°", 89.9},
                                           {"30°", 30.0},
                                           {"10°", 10.0},
                                           {"3°", 3.0},
                                           {"1°", 1.0},
                                           {"0.1°", 0.1}}) {
        Condition made = condition("light's elevation", value);
        made.stage.light = directional_light({-40, elevation}, 0.05);
        list.add(made, elevation == 90 || elevation == 10 || elevation == 0.1);
    }
    Condition spot = condition("spot", "outside the view");
    spot.stage = spot_stage();
    list.add(spot, true);
    spot.value = "in view";
    spot.stage.light = spot_light({-0.2, 2.1, -0.9}, {-0.2, 0, -0.7}, 0.05, 70);
    list.add(spot, true);
    spot.value = "behind the camera";
    const glm::dvec3 eye = spot.stage.camera.eye;
    spot.stage.light =
        spot_light(eye + 2.0 * spot.stage.camera.basis.back + glm::dvec3(-1, 0.5, 0), {0, 0.3, 0}, 0.15, 40);
    list.add(spot, false);
    spot.value = "cone of 85°";
    spot.stage.light = spot_light({-2.2, 4.1, 2.4}, {0, 0.2, -0.4}, 0.15, 85);
    list.add(spot, false);
    for (const auto& [value, half_tangent] : {std::pair("0", 0.0), {"1e-9", 1e-9}, {"0.5", 0.5}}) {
        Condition made = condition("light's half-tangent", value);
        made.stage.light.half_side = half_tangent;
        list.add(made, half_tangent == 0);
    }
}

void add_filters(List& list) {
    for (const auto& [value, radius] : {std::pair("0", 0.0), {"1e-9", 1e-9}, {"1", 1.0}, {"10", 10.0}, {"1e3", 1e3}}) {
        Condition made = condition("filter radius", value);
        made.radius = radius;
        list.add(made, radius == 0 || radius == 1e3);
        if (radius > 0) continue;
        made.value = "0, map of 512";
        made.fixed_size = 512;
        list.add(made, true);
    }
    for (const int size : {1, 2, 64, 4096}) {
        Condition made = condition("fixed map", std::to_string(size));
        made.fixed_size = size;
        list.add(made, size == 1);
    }
}

Mesh triangles(const std::vector<glm::vec3>& corners) {
    Mesh mesh;
    mesh.mover = 0;
    for (const glm::vec3& corner : corners) {
        mesh.indices.push_back(static_cast<uint32_t>(mesh.vertices.size()));
        mesh.vertices.push_back({corner, {0, 1, 0}, {0, 0}});
    }
    return mesh;
}

void add_triangles(List& list) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Condition made = condition("triangles", "without area");
    made.extra = {triangles(
        {{-0.4f, 0.5f, 0}, {0, 0.5f, 0}, {0.4f, 0.5f, 0}, {0.2f, 0.5f, 0.2f}, {0.2f, 0.5f, 0.2f}, {0.2f, 0.5f, 0.2f}})};
    list.add(made, true);
    made.value = "all of them twice";
    made.extra = scene_of(made.stage, 1).meshes;
    list.add(made, true);
    made.value = "NaN corners";
    made.extra = {triangles({{kNan, 0.5f, 0}, {0, 0.5f, 0.2f}, {0.4f, 0.5f, 0}}),
                  triangles({{kNan, kNan, kNan}, {kNan, kNan, kNan}, {kNan, kNan, kNan}}),
                  triangles({{0.1f, kNan, 0}, {0, 0.2f, kNan}, {0.4f, 0.5f, 0}})};
    list.add(made, true);
    made.value = "infinite corners";
    made.extra = {triangles({{kInfinity, 0.5f, 0}, {0, 0.5f, 0.2f}, {0.4f, 0.5f, 0}}),
                  triangles({{0.1f, -kInfinity, 0}, {0, 0.2f, kInfinity}, {0.4f, 0.5f, 0}})};
    list.add(made, true);
    made = condition("scene", "ground alone");
    made.stage.boxes.clear();
    list.add(made, true);
    made.value = "nothing at all";
    made.stage.ground_half_side = 0;
    list.add(made, true);
    made.value = "a mesh without triangles";
    made.extra = {Mesh{}};
    list.add(made, false);
}

/// A triangle that stretches the depths of a map, and nothing else: where no shadow of it is seen.
Mesh far_caster(const glm::dvec3& at) {
    const glm::vec3 corner(at);
    return triangles({corner, corner + glm::vec3(0.1f, 0, 0), corner + glm::vec3(0, 0.1f, 0.1f)});
}

/// With a thin wall instead of the box: the nearest to the light is next to its contact, too, and a gap there is what depths can't
/// tell apart. A box's top is far above its foot.
Stage with_wall(Stage stage) {
    Bounds& wall = stage.boxes.front();
    wall.low.z = -0.01;
    wall.high.z = 0.01;
    return stage;
}

void add_depths(List& list) {
    constexpr DepthFormat kFormats[]{DepthFormat::unorm16, DepthFormat::unorm24, DepthFormat::float32};
    const auto bits = [](DepthFormat format) { return std::to_string(bits_of(format)) + " bits"; };
    for (const auto& [range, reach] : {std::pair("", 0.0), {", casters over 1e2", 1e2}, {", casters over 1e4", 1e4}}) {
        for (const DepthFormat format : kFormats) {
            Condition made = condition("depth, directional", bits(format) + range);
            made.stage = with_wall(plain_stage());
            made.depth.format = format;
            // Towards the light, and aside by more than the ground is wide.
            const Basis& light = made.stage.light.basis;
            if (reach > 0) made.extra = {far_caster(reach * light.back + 60.0 * light.right)};
            list.add(made, format == DepthFormat::unorm16 && reach < 1e4);
        }
    }
    struct Range {
        const char* value;
        /// Of a caster, along the light; 0 for none.
        double depth;
    };
    for (const Range& range : {Range{"", 0}, Range{", a caster behind it", -1}, Range{", a caster 1e3 away", 1e3}}) {
        for (const SpotDepth spot : {SpotDepth::reciprocal, SpotDepth::linear}) {
            for (const DepthFormat format : kFormats) {
                Condition made =
                    condition("depth, spot", std::string(name(spot)) + ", " + bits(format) + std::string(range.value));
                made.stage = with_wall(spot_stage());
                made.depth = {format, spot};
                const Light& light = made.stage.light;
                if (range.depth != 0) made.extra = {far_caster(light.position - range.depth * light.basis.back)};
                list.add(made, format == DepthFormat::unorm16 && spot == SpotDepth::reciprocal && range.depth < 1e3);
            }
        }
    }
}

void add_courses(List& list, bool quick, bool long_run) {
    Condition made = condition("changes of size", quick ? "200" : "10000");
    made.course = Course::sizes;
    made.steps = quick ? 200 : 10000;
    list.add(made, true);
    const int frames = quick ? 3 * kPeriod : long_run ? 100000 : 2000;
    made = condition("frames", std::to_string(frames));
    made.course = Course::frames;
    made.steps = frames;
    list.add(made, true);
}

}  // namespace

std::vector<Condition> all_conditions(bool quick, bool long_run) {
    List list(quick);
    add_places(list);
    add_lights(list);
    add_filters(list);
    add_triangles(list);
    add_depths(list);
    add_courses(list, quick, long_run);
    return std::move(list.conditions);
}

Stage swung(const Stage& stage, int frame) {
    Stage moved = stage;
    const double swing = std::sin(2 * std::numbers::pi * (frame % kPeriod) / kPeriod);
    moved.light = directional_light({-40 + 15 * swing, 50 + 10 * swing}, stage.light.half_tangent());
    return moved;
}

}  // namespace stairstep::stress
