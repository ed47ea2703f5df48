#include "renderer/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stairstep {
namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

/// Nearest fit along one axis: at which sideways position and distance the planes of a field of view, of
/// half-tangent t, touch the points on either side. With s the sideways coordinate and b the one towards the
/// eye, a point is inside when |s − position| ≤ t·(distance − b).
struct AxisFit {
    double position;
    double distance;
};

AxisFit fit_axis(const std::vector<glm::dvec3>& points, const glm::dvec3& sideways, const glm::dvec3& back, double t) {
    double right = -INFINITY;
    double left = -INFINITY;
    for (const glm::dvec3& point : points) {
        const double s = glm::dot(point, sideways);
        const double b = glm::dot(point, back);
        right = std::max(right, s + t * b);
        left = std::max(left, -s + t * b);
    }
    return {(right - left) / 2, (right + left) / (2 * t)};
}

}  // namespace

Basis basis_towards(const Direction& direction) {
    const double azimuth = radians(direction.azimuth_deg);
    const double elevation = radians(direction.elevation_deg);
    const glm::dvec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                          std::cos(azimuth) * std::cos(elevation));
    const glm::dvec3 right(std::cos(azimuth), 0, -std::sin(azimuth));
    return {right, glm::cross(back, right), back};
}

Direction direction_of(const glm::dvec3& vector) {
    const double across = std::hypot(vector.x, vector.z);
    const double degrees = 180 / std::numbers::pi;
    return {std::atan2(vector.x, vector.z) * degrees, std::atan2(vector.y, across) * degrees};
}

Camera camera_looking_at(const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov_deg, double near,
                         double far) {
    return {basis_towards(direction_of(eye - target)), eye, vertical_fov_deg, near, far};
}

Camera framing_camera(const std::vector<glm::dvec3>& points, const Direction& direction, double aspect,
                      double distance_factor, double reach) {
    Camera camera;
    camera.basis = basis_towards(direction);
    const auto& [right, up, back] = camera.basis;
    // A margin of 6 % of the picture on each side.
    const double tangent = 0.88 * std::tan(radians(camera.vertical_fov_deg) / 2);
    const AxisFit x = fit_axis(points, right, back, tangent * aspect);
    const AxisFit y = fit_axis(points, up, back, tangent);

    double nearest = -INFINITY;
    double farthest = INFINITY;
    for (const glm::dvec3& point : points) {
        nearest = std::max(nearest, glm::dot(point, back));
        farthest = std::min(farthest, glm::dot(point, back));
    }
    const double middle = (nearest + farthest) / 2;
    const double along = middle + (std::max(x.distance, y.distance) - middle) * distance_factor;
    camera.eye = x.position * right + y.position * up + along * back;
    camera.far = (along - farthest) + reach;
    // What lies between the eye and the points is the ground at most, which no one misses; a camera inside
    // the points, as a small factor makes it, still sees most of them.
    camera.near = std::max((along - nearest) / 2, camera.far * 1e-4);
    return camera;
}

std::vector<glm::dvec3> points_of_interest(const Bounds& casters, const Direction& light) {
    const glm::dvec3 to_light = basis_towards(light).back;
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner = casters.corner(i);
        points.push_back(corner);
        const double along = (corner.y - casters.low.y) / std::max(to_light.y, 1e-9);
        points.push_back(corner - std::min(along, 2 * casters.diagonal()) * to_light);
    }
    return points;
}

glm::dmat4 clip_from_world(const Camera& camera, double aspect) {
    const auto& [right, up, back] = camera.basis;
    const glm::dmat4 view(
        glm::dvec4(right.x, up.x, back.x, 0), glm::dvec4(right.y, up.y, back.y, 0),
        glm::dvec4(right.z, up.z, back.z, 0),
        glm::dvec4(-glm::dot(right, camera.eye), -glm::dot(up, camera.eye), -glm::dot(back, camera.eye), 1));
    const double zoom = 1 / std::tan(radians(camera.vertical_fov_deg) / 2);
    const double depth = camera.far / (camera.near - camera.far);
    const glm::dmat4 projection(glm::dvec4(zoom / aspect, 0, 0, 0), glm::dvec4(0, zoom, 0, 0),
                                glm::dvec4(0, 0, depth, -1), glm::dvec4(0, 0, depth * camera.near, 0));
    return projection * view;
}

double pixel_footprint(const Camera& camera, double distance, int height_px) {
    return 2 * distance * std::tan(radians(camera.vertical_fov_deg) / 2) / height_px;
}

}  // namespace stairstep
