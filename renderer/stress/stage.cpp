#include "renderer/stress/stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace stairstep::stress {
namespace {

/// A ray that starts on a box's face is not hidden by that face: the share of a unit that it is let off.
constexpr double kOffSurface = 1e-9;

/// Where a line enters and leaves a box, in lengths of its direction, and across which axes; empty (first > last) where it
/// misses it.
struct Crossing {
    double first = -INFINITY;
    double last = INFINITY;
    int first_axis = 0;
    int last_axis = 0;
};

Crossing crossing(const Bounds& box, const glm::dvec3& origin, const glm::dvec3& direction) {
    Crossing crossing;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) {
            if (origin[axis] <= box.low[axis] || origin[axis] >= box.high[axis]) return {INFINITY, -INFINITY, 0, 0};
            continue;
        }
        double near = (box.low[axis] - origin[axis]) / direction[axis];
        double far = (box.high[axis] - origin[axis]) / direction[axis];
        if (near > far) std::swap(near, far);
        if (near > crossing.first) {
            crossing.first = near;
            crossing.first_axis = axis;
        }
        if (far < crossing.last) {
            crossing.last = far;
            crossing.last_axis = axis;
        }
    }
    return crossing;
}

Mesh quad(const std::array<glm::vec3, 4>& corners, bool casts) {
    Mesh mesh;
    mesh.casts = casts;
    mesh.mover = 0;
    for (const glm::vec3& corner : corners) mesh.vertices.push_back({corner, {0, 1, 0}, {0, 0}});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

/// The four corners of a box's side, in order around it.
std::array<glm::vec3, 4> side_of(const Bounds& box, int axis, double at, double scale) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::array<glm::vec3, 4> corners;
    for (int i = 0; i < 4; ++i) {
        glm::dvec3 corner;
        corner[axis] = at;
        corner[u] = i == 0 || i == 3 ? box.low[u] : box.high[u];
        corner[v] = i < 2 ? box.low[v] : box.high[v];
        corners[i] = glm::vec3(scale * corner);
    }
    return corners;
}

Bounds box_between(const glm::dvec3& low, const glm::dvec3& high) {
    Bounds box;
    box.add(low);
    box.add(high);
    return box;
}

}  // namespace

Stage plain_stage() {
    Stage stage;
    stage.boxes = {box_between({-0.5, 0, -0.5}, {0.5, 1, 0.5}), box_between({-1.9, 1.2, -0.7}, {-0.9, 1.3, 0.4})};
    stage.light = directional_light({-40, 50}, 0.05);
    stage.camera = camera_looking_at({2.6, 3.4, 3.8}, {-0.2, 0.3, -0.3}, 38, 0.1, 60);
    return stage;
}

Stage spot_stage() {
    Stage stage = plain_stage();
    stage.light = spot_light({-2.2, 4.1, 2.4}, {0, 0.2, -0.4}, 0.15, 40);
    return stage;
}

Scene scene_of(const Stage& stage, double scale) {
    Scene scene;
    scene.materials.emplace_back();
    for (const Bounds& box : stage.boxes) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double at : {box.low[axis], box.high[axis]}) {
                scene.meshes.push_back(quad(side_of(box, axis, at, scale), true));
            }
        }
    }
    if (stage.ground_half_side > 0) {
        const auto s = static_cast<float>(stage.ground_half_side * scale);
        scene.meshes.push_back(quad({{{-s, 0, -s}, {-s, 0, s}, {s, 0, s}, {s, 0, -s}}}, false));
    }
    return scene;
}

SceneState state_of(const Stage& stage, const Placement& placement) {
    SceneState state;
    state.camera = stage.camera;
    state.camera.eye = placement.offset + placement.scale * stage.camera.eye;
    state.camera.near *= placement.scale;
    state.camera.far *= placement.scale;
    state.light = stage.light;
    state.light.position = placement.offset + placement.scale * stage.light.position;
    // Of a directional light, its angle: both lengths grow alike.
    state.light.half_side *= placement.scale;
    state.light.distance *= placement.scale;
    glm::dmat4 world_from_home(1);
    world_from_home[3] = glm::dvec4(placement.offset, 1);
    state.movers = {world_from_home};
    return state;
}

std::optional<SeenPoint> seen_at(const Stage& stage, int column, int row, int width, int height) {
    const Camera& camera = stage.camera;
    const double up = std::tan(camera.vertical_fov_deg * std::numbers::pi / 360);
    const double x = (2 * column + 1.0 - width) / height * up;
    const double y = (height - 2 * row - 1.0) / height * up;
    // One unit deep along the view: what is met at t is t deep.
    const glm::dvec3 direction = x * camera.basis.right + y * camera.basis.up - camera.basis.back;
    double nearest = camera.far;
    std::optional<SeenPoint> seen;
    const auto meet = [&](double depth, int axis, int face) {
        if (!(depth >= camera.near && depth < nearest)) return;
        nearest = depth;
        glm::dvec3 normal(0);
        normal[axis] = direction[axis] > 0 ? -1 : 1;
        seen = {camera.eye + depth * direction, normal, face};
    };
    for (size_t i = 0; i < stage.boxes.size(); ++i) {
        const Crossing crossed = crossing(stage.boxes[i], camera.eye, direction);
        if (crossed.first > crossed.last) continue;
        const auto face = [&](int axis, bool entered) {
            return static_cast<int>(6 * i) + 2 * axis + ((direction[axis] > 0) == entered ? 0 : 1);
        };
        meet(crossed.first, crossed.first_axis, face(crossed.first_axis, true));
        meet(crossed.last, crossed.last_axis, face(crossed.last_axis, false));
    }
    if (stage.ground_half_side > 0 && direction.y != 0) {
        const double depth = -camera.eye.y / direction.y;
        const glm::dvec3 point = camera.eye + depth * direction;
        if (std::max(std::abs(point.x), std::abs(point.z)) <= stage.ground_half_side) meet(depth, 1, -1);
    }
    return seen;
}

bool faces_light(const Light& light, const SeenPoint& point) {
    if (light.kind == Light::Kind::directional) return glm::dot(point.normal, light.basis.back) > 0;
    const glm::dvec3 to_light = light.position - point.position;
    return glm::dot(point.normal, to_light) > 0 &&
           glm::dot(light.basis.back, to_light) >=
               std::cos(light.cone_deg * std::numbers::pi / 180) * glm::length(to_light);
}

bool is_hidden(const Stage& stage, const glm::dvec3& point, double u, double v) {
    const Light& light = stage.light;
    const bool spot = light.kind == Light::Kind::spot;
    const glm::dvec3 across = light.half_side * (u * light.basis.right + v * light.basis.up);
    const glm::dvec3 way = spot ? light.position + across - point : light.basis.back + across / light.distance;
    const double end = spot ? 1 : INFINITY;
    return std::ranges::any_of(stage.boxes, [&](const Bounds& box) {
        const Crossing crossed = crossing(box, point, way);
        return crossed.last > kOffSurface && crossed.first < end && crossed.last - crossed.first > kOffSurface;
    });
}

}  // namespace stairstep::stress
