// The light: a square that shines from far away (directional) or from a place (spot).
//
// The square lies across basis.back, its sides along basis.right and basis.up. Seen from a receiver p its points are
//
//   directional   p + distance·back + u·right + v·up, wherever p is: the square moves along, as the sun does
//   spot          position + u·right + v·up
//
// for |u|, |v| ≤ half_side. Light travels along −back. Of a directional light only half_side/distance matters: the
// tangent of half its angle, 0.00465 for the sun.
//
// A caster at depth z_b and a receiver at z_r along the light have a penumbra whose filter is a box of half-width
//
//   directional   (half_side/distance)·(z_r − z_b)            world units across the light
//   spot          half_side·(1/z_b − 1/z_r)                   tangents: world units at depth 1
//
// (Kreuzer 2017, eqs. 5.10 and 5.11, with the map's plane at depth 1).
#pragma once

#include <glm/glm.hpp>

#include "renderer/view.h"

namespace stairstep {

struct Light {
    enum class Kind { directional, spot };

    Kind kind = Kind::directional;
    /// back points from the scene to the light.
    Basis basis = basis_towards(Direction{});
    /// Middle of a spot's square, world units.
    glm::dvec3 position{0};
    /// Half the side of the square, world units, ≥ 0; 0 is a point.
    double half_side = 0;
    /// Of a directional light's square from every receiver, world units, > 0.
    double distance = 1;
    /// A spot lights what lies within this angle of its axis, degrees in (0, 85].
    double cone_deg = 35;

    bool operator==(const Light&) const = default;

    /// Tangent of half the angle under which a directional light is seen.
    double half_tangent() const { return half_side / distance; }
};

/// A directional light from there, whose square is seen under this half-tangent.
inline Light directional_light(const Direction& direction, double half_tangent) {
    return {Light::Kind::directional, basis_towards(direction), {}, half_tangent, 1, 35};
}

/// A spot at `position` that shines towards `target`, which must be elsewhere.
Light spot_light(const glm::dvec3& position, const glm::dvec3& target, double half_side, double cone_deg);

/// Depth of a point along the light, away from it: measured from a spot's position, or from the world's origin.
inline double depth_along(const Light& light, const glm::dvec3& point) {
    return glm::dot(light.basis.back, (light.kind == Light::Kind::spot ? light.position : glm::dvec3(0)) - point);
}

}  // namespace stairstep
