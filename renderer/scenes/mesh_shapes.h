// Shapes that procedural scenes are built of, appended to a mesh: closed, wound counter-clockwise seen from outside,
// with unit normals that point outwards. All but the grid are watertight: each edge belongs to two triangles, which
// run along it in opposite directions.
//
// All closed shapes are one: an outline swept along z in sections, its volume, for an outline of area A,
//
//   V = A · Σ (z₁ − z₀)(s₀² + s₀·s₁ + s₁²)/3      over neighbouring sections (z, s)
//
// A box of half-sizes 1, 2, 3 has the volume 48 and 12 triangles.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene.h"
#include "renderer/view.h"

namespace stairstep {

/// A cross-section of a sweep: the outline, scaled, at a height along z. World units.
struct Section {
    double z = 0;
    /// ≥ 0; 0 is the tip of a cone.
    double scale = 1;
};

/// Appends the outline swept through the sections. The outline is a polygon in x and y, counter-clockwise seen from +z,
/// that is seen whole from the origin. Sections, at least two, have ascending z; no two neighbours have scale 0.
/// `world_from_shape` rotates and translates. Where the sides of the outline meet at under 40° they are shaded as a
/// curve, and so are sections, else with an edge.
void append_sweep(Mesh& mesh, const std::vector<glm::dvec2>& outline, std::span<const Section> sections,
                  const glm::dmat4& world_from_shape);

/// A regular polygon around the origin, its corners at `radius`; sides ≥ 3.
std::vector<glm::dvec2> regular_outline(double radius, int sides);

/// A box around the origin of its own space.
void append_box(Mesh& mesh, const glm::dvec3& half_size, const glm::dmat4& world_from_box);

/// A box along the axes, low < high.
void append_box(Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high);

/// A bar of square section from one point to another; its ends are square to it.
void append_beam(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double width);

/// A round bar of that many sides, or a cone frustum.
void append_cylinder(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double radius_from, double radius_to,
                     int sides);

/// What turns around a vertical axis that starts at `foot`: radii over heights above it, ascending.
void append_turned(Mesh& mesh, const glm::dvec3& foot, std::span<const glm::dvec2> radius_and_height, int sides);

/// A parallelogram of cells_u × cells_v cells, seen from the side that u × v points to.
void append_grid(Mesh& mesh, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int cells_u,
                 int cells_v);

/// The rigid transform whose z axis points along `axis` (any length but 0), its origin at `origin`.
glm::dmat4 frame_along(const glm::dvec3& origin, const glm::dvec3& axis);

/// Rotation by an angle about a vertical axis through a point, degrees, from +z towards +x as azimuths are.
glm::dmat4 turn_about(const glm::dvec3& point, double angle_deg);

/// Rotation by an angle about any unit axis through a point, degrees, by the right hand.
glm::dmat4 rotate_about(const glm::dvec3& point, const glm::dvec3& axis, double angle_deg);

}  // namespace stairstep
