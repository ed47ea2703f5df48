// Where the picture is taken from and where the light comes from.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene.h"

namespace stairstep {

/// A direction as two angles, degrees: azimuth about y from +z towards +x, elevation above the horizon.
struct Direction {
    double azimuth_deg = 0;
    double elevation_deg = 45;
};

/// Three perpendicular unit vectors; `back` points along the direction, so right × up = back.
struct Basis {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 back;

    bool operator==(const Basis&) const = default;
};

/// The basis that looks against `direction`, `right` being horizontal; well defined straight up and down as
/// well.
Basis basis_towards(const Direction& direction);

/// The direction of a vector, of any length but 0.
Direction direction_of(const glm::dvec3& vector);

/// A perspective camera, looking along −back.
struct Camera {
    Basis basis;
    glm::dvec3 eye;
    double vertical_fov_deg = 30;
    /// Distances along the view, world units, 0 < near < far.
    double near = 0.1;
    double far = 100;

    bool operator==(const Camera&) const = default;
};

/// A camera at `eye` that looks at `target`, which must be elsewhere.
Camera camera_looking_at(const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov_deg, double near,
                         double far);

/// The camera that sees all `points` as large as they will fit a picture of this aspect (width/height), at
/// `distance_factor` times that distance. far reaches `reach` world units beyond the points.
Camera framing_camera(const std::vector<glm::dvec3>& points, const Direction& direction, double aspect,
                      double distance_factor, double reach);

/// The casters' corners and where their shadow falls on the ground: what a picture of a shadow should show.
/// At low light shadows are endless; they count up to two diagonals away.
std::vector<glm::dvec3> points_of_interest(const Bounds& casters, const Direction& light);

/// Clip space with y up and depth from 0 (near) to 1 (far).
glm::dmat4 clip_from_world(const Camera& camera, double aspect);

/// Side of a pixel at a distance along the view, world units.
double pixel_footprint(const Camera& camera, double distance, int height_px);

}  // namespace stairstep
