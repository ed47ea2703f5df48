#include "renderer/light_frustum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace stairstep {
namespace {

using Points = std::vector<glm::dvec2>;

struct Rectangle {
    glm::dvec2 low{INFINITY};
    glm::dvec2 high{-INFINITY};

    void add(const glm::dvec2& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    bool empty() const { return !(low.x <= high.x && low.y <= high.y); }
    double area() const { return empty() ? 0 : (high.x - low.x) * (high.y - low.y); }
};

Rectangle overlap(const Rectangle& a, const Rectangle& b) {
    return {glm::max(a.low, b.low), glm::min(a.high, b.high)};
}

Rectangle widened(const Rectangle& a, double margin) {
    return {a.low - margin, a.high + margin};
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Corners of the convex hull, anticlockwise (Andrew 1979).
Points convex_hull(Points points) {
    const auto before = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
    std::sort(points.begin(), points.end(), before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Points hull;
    for (const int pass : {0, 1}) {
        const size_t first = hull.size();
        for (const glm::dvec2& point : points) {
            while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0) {
                hull.pop_back();
            }
            hull.push_back(point);
        }
        hull.pop_back();
        if (pass == 0) std::reverse(points.begin(), points.end());
    }
    return hull;
}

glm::dvec2 turned(const glm::dvec2& point, const glm::dvec2& axis) {
    return {glm::dot(point, axis), cross(axis, point)};
}

Rectangle around(const Points& points, const glm::dvec2& axis) {
    Rectangle rectangle;
    for (const glm::dvec2& point : points) rectangle.add(turned(point, axis));
    return rectangle;
}

/// The first axis of the rectangle that is smallest. Of the overlap of two bounding rectangles, too, one side lies along
/// a side of a hull: between the angles at which a hull's touching corner changes, its extent is a sine, which has no
/// minimum inside.
glm::dvec2 axis_of_smallest(const Points& casters, const Points& receivers, double reach) {
    const Points caster_hull = convex_hull(casters);
    const Points receiver_hull = convex_hull(receivers);
    glm::dvec2 best(1, 0);
    double smallest = INFINITY;
    for (const Points* hull : {&caster_hull, &receiver_hull}) {
        for (size_t i = 0; i < hull->size(); ++i) {
            const glm::dvec2 side = (*hull)[(i + 1) % hull->size()] - (*hull)[i];
            if (!(glm::length(side) > 0)) continue;
            const glm::dvec2 axis = glm::normalize(side);
            const Rectangle rectangle = overlap(around(caster_hull, axis), widened(around(receiver_hull, axis), reach));
            if (!rectangle.empty() && rectangle.area() < smallest) {
                smallest = rectangle.area();
                best = axis;
            }
        }
    }
    return best;
}

/// The part of a convex polygon that lies in a rectangle (Sutherland & Hodgman 1974).
Points cut_to(Points polygon, const Rectangle& rectangle) {
    for (const int axis : {0, 1}) {
        for (const double sign : {1.0, -1.0}) {
            const double limit = sign * (sign > 0 ? rectangle.low[axis] : rectangle.high[axis]);
            Points kept;
            for (size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec2& a = polygon[i];
                const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
                const double side_a = sign * a[axis] - limit;
                const double side_b = sign * b[axis] - limit;
                if (side_a >= 0) kept.push_back(a);
                if ((side_a >= 0) != (side_b >= 0)) kept.push_back(a + side_a / (side_a - side_b) * (b - a));
            }
            polygon = std::move(kept);
        }
    }
    return polygon;
}

/// What of the rectangle is within `reach` of receivers; all of it where that is no polygon.
Points seen_body(const Points& receivers, const glm::dvec2& axis, double reach, const Rectangle& rectangle) {
    Points around;
    for (const glm::dvec2& receiver : receivers) {
        const glm::dvec2 place = turned(receiver, axis);
        for (const glm::dvec2& to : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
            around.push_back(place + reach * to);
        }
    }
    Points body = cut_to(convex_hull(std::move(around)), rectangle);
    if (body.size() >= 3) return body;
    const auto& [low, high] = rectangle;
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}

/// A view this much along the light, as the sine of the angle between them, has no direction in the light plane.
constexpr double kLeastAngle = 1e-6;

/// The axis across the view's direction in the light plane, which then is the other, and the sine of the angle to the light.
std::pair<glm::dvec2, double> axis_across_view(const Basis& light, const Camera& camera) {
    const glm::dvec2 along(-glm::dot(light.right, camera.basis.back), -glm::dot(light.up, camera.basis.back));
    const double sine = glm::length(along);
    if (!(sine > kLeastAngle)) return {{1, 0}, 0};
    return {glm::dvec2(along.y, -along.x) / sine, std::min(sine, 1.0)};
}

/// The casters' diagonal, or what rounding can tell of them where they all lie in one point; above 0.
double extent_of(const Bounds& casters) {
    if (casters.empty()) return 1;
    const double size = glm::length(glm::max(glm::abs(casters.low), glm::abs(casters.high)));
    const double extent = std::max(casters.diagonal(), 1e-6 * size);
    return extent > 0 ? extent : 1;
}

/// Depths along the light between which the casters lie, clear of both ends, also when all lie in one plane across the
/// light: rounding must not clip the first, nor make the last as deep as an empty texel.
void set_depths(LightFrustum& frustum, const Bounds& casters, double clearance) {
    if (casters.empty()) {
        frustum.nearest = frustum.kind == Light::Kind::spot ? 0.5 : 0;
        frustum.farthest = frustum.nearest + 1;
        return;
    }
    frustum.nearest = casters.low.z - clearance;
    frustum.farthest = casters.high.z + clearance;
    if (frustum.kind == Light::Kind::spot) {
        // All casters behind the light: any depth will do.
        frustum.farthest = std::max(frustum.farthest, clearance);
        frustum.nearest = std::max(frustum.nearest, frustum.farthest * 1e-3);
        const double last = std::max(casters.high.z, frustum.nearest);
        frustum.farthest = std::max(frustum.farthest, least_farthest(frustum.encoding, frustum.nearest, last));
    }
}

/// The planes of a frustum's four sides, each `reach` further out.
std::vector<glm::dvec4> side_planes(const LightFrustum& frustum, double reach) {
    const auto& [right, up, back] = frustum.basis;
    std::vector<glm::dvec4> planes;
    const auto add = [&](const glm::dvec3& axis, double offset) {
        // Along the axis from the light, no less than the offset; a spot's grows with depth.
        const bool spot = frustum.kind == Light::Kind::spot;
        const glm::dvec3 normal = spot ? axis + offset * back : axis;
        planes.emplace_back(normal, -glm::dot(normal, frustum.position) - (spot ? 0 : offset));
    };
    add(right, frustum.low.x - reach);
    add(up, frustum.low.y - reach);
    add(-right, -frustum.high.x - reach);
    add(-up, -frustum.high.y - reach);
    return planes;
}

/// A search on a coarse level sees up to this much further than its reach.
constexpr double kCasterMargin = 1.5;

/// Planes along the light around the hull of the receivers, `reach` away from it along the map's axes, and one behind the farthest.
std::vector<glm::dvec4> planes_around(const LightFrustum& frustum, const Points& receivers, double reach,
                                      double farthest_receiver) {
    const auto& [right, up, back] = frustum.basis;
    const bool spot = frustum.kind == Light::Kind::spot;
    const auto plane = [&](const glm::dvec3& normal, double offset) {
        return glm::dvec4(normal, offset - glm::dot(normal, frustum.position));
    };
    std::vector<glm::dvec4> planes{plane(back, farthest_receiver)};
    const Points hull = convex_hull(receivers);
    for (size_t i = 0; hull.size() >= 3 && i < hull.size(); ++i) {
        const glm::dvec2 side = hull[(i + 1) % hull.size()] - hull[i];
        const glm::dvec2 inward = glm::dvec2(-side.y, side.x) / glm::length(side);
        const double offset = reach * (std::abs(inward.x) + std::abs(inward.y)) - glm::dot(inward, hull[i]);
        const glm::dvec3 across = inward.x * right + inward.y * up;
        // A spot's lengths are tangents: over the depth along it.
        planes.push_back(spot ? plane(across - offset * back, 0) : plane(across, offset));
    }
    return planes;
}

}  // namespace

glm::dvec3 light_plane_point(const LightFrustum& frustum, const glm::dvec3& world) {
    const auto& [right, up, back] = frustum.basis;
    const glm::dvec3 from_light = world - frustum.position;
    const glm::dvec3 point(glm::dot(right, from_light), glm::dot(up, from_light), -glm::dot(back, from_light));
    if (frustum.kind == Light::Kind::directional) return point;
    return {point.x / point.z, point.y / point.z, point.z};
}

LightFrustum fit_light_frustum(const SceneExtents& extents, const SceneState& state, double aspect, Fit fit,
                               const Reach& reach, Warp warp, const DepthEncoding& encoding) {
    const Light& light = state.light;
    const bool spot = light.kind == Light::Kind::spot;
    LightFrustum frustum;
    frustum.kind = light.kind;
    frustum.encoding = encoding;
    frustum.basis = light.basis;
    if (spot) frustum.position = light.position;

    // Casters, in light space: across the light and along it.
    Bounds casters;
    std::vector<glm::dvec3> caster_points;
    for (size_t i = 0; i < extents.parts.size(); ++i) {
        const glm::dmat4 world_from_part = SceneExtents::placement(state, i);
        const auto& [right, up, back] = frustum.basis;
        const glm::dmat4 light_from_world(
            glm::dvec4(right.x, up.x, -back.x, 0), glm::dvec4(right.y, up.y, -back.y, 0),
            glm::dvec4(right.z, up.z, -back.z, 0),
            glm::dvec4(-glm::dot(right, frustum.position), -glm::dot(up, frustum.position),
                       glm::dot(back, frustum.position), 1));
        const glm::dmat4 light_from_part = light_from_world * world_from_part;
        for (const glm::vec3& corner : extents.parts[i].casters) {
            const glm::dvec3 point(light_from_part * glm::dvec4(corner, 1));
            casters.add(point);
            caster_points.emplace_back(point);
        }
    }
    const double diagonal = extent_of(casters);
    set_depths(frustum, casters, 1e-3 * diagonal);
    const double depth_range = frustum.farthest - frustum.nearest;
    frustum.softness = spot ? light.half_side * depth_range / (frustum.nearest * frustum.farthest)
                            : light.half_tangent() * depth_range;

    // Both sets in the light plane. A caster at or behind a spot's nearest depth may be anywhere across.
    Points caster_plane;
    bool anywhere = false;
    for (const glm::dvec3& point : caster_points) {
        if (spot && point.z <= frustum.nearest) {
            anywhere = true;
        } else {
            caster_plane.emplace_back(spot ? glm::dvec2(point) / point.z : glm::dvec2(point));
        }
    }
    const double cone = std::tan(light.cone_deg * std::numbers::pi / 180);
    const Points whole_cone{{-cone, -cone}, {cone, -cone}, {cone, cone}, {-cone, cone}};
    if (anywhere) caster_plane = whole_cone;

    std::vector<glm::dvec4> planes = view_planes(state.camera, aspect);
    if (spot) {
        // What lies behind the light, or nearer than any caster, receives no shadow.
        const glm::dvec3 along = -frustum.basis.back;
        planes.emplace_back(along, -glm::dot(along, frustum.position) - frustum.nearest);
    }
    Points receiver_plane;
    double farthest_receiver = frustum.nearest;
    for (size_t i = 0; i < extents.parts.size(); ++i) {
        for (const glm::dvec3& corner :
             cut_corners(extents.parts[i].meshes, SceneExtents::placement(state, i), planes)) {
            const glm::dvec3 point = light_plane_point(frustum, corner);
            receiver_plane.emplace_back(point);
            farthest_receiver = std::max(farthest_receiver, point.z);
        }
    }

    frustum.receiver_depth = (farthest_receiver - frustum.nearest) / depth_range;
    if (spot) frustum.receiver_depth *= frustum.farthest / farthest_receiver;
    const double look_around = reach(frustum);
    glm::dvec2 axis(1, 0);
    double warp_angle = 0;
    if (warp == Warp::lispsm && !spot) {
        std::tie(axis, warp_angle) = axis_across_view(frustum.basis, state.camera);
    } else if (fit == Fit::smallest_rectangle && !caster_plane.empty() && !receiver_plane.empty()) {
        axis = axis_of_smallest(caster_plane, receiver_plane, look_around);
    }
    if (axis != glm::dvec2(1, 0)) {
        const Basis own = frustum.basis;
        frustum.basis.right = axis.x * own.right + axis.y * own.up;
        frustum.basis.up = axis.x * own.up - axis.y * own.right;
    }
    const double least = 1e-6 * (spot ? cone : diagonal) + std::numeric_limits<double>::min();
    Points receivers;
    for (const glm::dvec2& point : receiver_plane) receivers.push_back(turned(point, axis));
    frustum.caster_planes = planes_around(frustum, receivers, kCasterMargin * look_around + least, farthest_receiver);
    Rectangle seen = overlap(around(caster_plane, axis), widened(around(receiver_plane, axis), look_around));
    if (spot) seen = overlap(seen, widened(around(whole_cone, axis), look_around));
    // Nothing that casts a shadow on anything visible: a map of any place will do.
    if (seen.empty()) {
        frustum.shadowless = true;
        seen = {glm::dvec2(-look_around), glm::dvec2(look_around)};
    }
    frustum.low = seen.low - least;
    frustum.high = seen.high + least;

    for (const glm::dvec4& plane : side_planes(frustum, look_around)) planes.push_back(plane);
    frustum.view_range = {INFINITY, 0};
    double& nearest_view = frustum.view_range.x;
    double& farthest_view = frustum.view_range.y;
    for (size_t i = 0; i < extents.parts.size(); ++i) {
        for (const glm::dvec3& corner :
             cut_corners(extents.parts[i].meshes, SceneExtents::placement(state, i), planes)) {
            const double distance = glm::dot(state.camera.eye - corner, state.camera.basis.back);
            nearest_view = std::min(nearest_view, distance);
            farthest_view = std::max(farthest_view, distance);
        }
    }
    if (warp_angle > 0 && !frustum.shadowless && std::isfinite(nearest_view)) {
        const double nearest = std::max(nearest_view, state.camera.near);
        frustum.warp = lispsm_warp(seen_body(receiver_plane, axis, look_around, seen),
                                   {warp_angle, nearest, std::max(farthest_view, nearest),
                                    glm::dot(frustum.basis.right, state.camera.eye - frustum.position), look_around},
                                   least);
    }
    return frustum;
}

}  // namespace stairstep
