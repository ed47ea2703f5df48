// A straight edge parallel to a light's square, whose penumbra is known: the box filter of its silhouette with light.h's
// half-width, anywhere below.
#pragma once

#include <cmath>
#include <numbers>

#include "stimuli/visibility.h"
#include "tests/renderer/made_scenes.h"

namespace stairstep::made {

inline constexpr int kEdgeWidth = 192;
inline constexpr int kEdgeHeight = 144;

/// A half-plane at a depth along the light; in the light plane it lies to the right of a line through the origin that
/// runs at `angle_deg` from basis.right.
struct StraightEdge {
    Light light;
    double depth = 0;
    double angle_deg = 0;

    glm::dvec2 along() const {
        const double angle = angle_deg * std::numbers::pi / 180;
        return {std::cos(angle), std::sin(angle)};
    }

    glm::vec3 at_depth(const glm::dvec2& across) const {
        const glm::dvec3 origin = light.kind == Light::Kind::spot ? light.position : glm::dvec3(0);
        return glm::vec3(origin + across.x * light.basis.right + across.y * light.basis.up - depth * light.basis.back);
    }

    Mesh caster(double half_side = 2.5) const {
        const glm::dvec2 forth = half_side * along();
        const glm::dvec2 right(forth.y, -forth.x);
        return polygon({at_depth(-forth), at_depth(forth), at_depth(forth + right), at_depth(right - forth)}, true);
    }

    /// light.h's half-width at a point, light plane.
    double radius(const glm::dvec3& point) const {
        const double receiver = depth_along(light, point);
        return light.kind == Light::Kind::spot ? light.half_side * (1 / depth - 1 / receiver)
                                               : light.half_tangent() * (receiver - depth);
    }

    /// Signed distance from the edge's shadow under a point light, positive in the light, light plane.
    double distance(const glm::dvec3& point) const {
        const glm::dvec3 from = light.kind == Light::Kind::spot ? point - light.position : point;
        glm::dvec2 place(glm::dot(light.basis.right, from), glm::dot(light.basis.up, from));
        if (light.kind == Light::Kind::spot) place /= depth_along(light, point);
        return along().x * place.y - along().y * place.x;
    }

    /// V of the box of this half-width.
    double visibility(const glm::dvec3& point, double half_width) const {
        // The box looks the same from all four sides: a line less steep than 45° will do.
        const glm::dvec2 a = glm::abs(along());
        const double slope = std::min(a.x, a.y) / std::max(a.x, a.y);
        return stairstep::visibility(Edge::line(slope), {KernelShape::box, half_width},
                                     {0, distance(point) * std::hypot(1.0, slope)});
    }
    double visibility(const glm::dvec3& point) const { return visibility(point, radius(point)); }
};

/// Looks straight down on the ground at y = 0, from below the casters.
inline const Camera kEdgeCamera = camera_down({0.1, 1, -0.05});

inline glm::dvec3 edge_point(int column, int row) {
    return point_below(kEdgeCamera, column, row, kEdgeWidth, kEdgeHeight, 0);
}

/// Half-widths of some 0.25 and 0.05 in the light plane, where the picture is some 1.4 and 0.28 wide.
inline StraightEdge straight_edge(Light::Kind kind, double angle_deg, double softness = 1) {
    const Direction slanted{30, 55};
    if (kind == Light::Kind::directional) return {directional_light(slanted, 0.1 * softness), -2.5, angle_deg};
    return {spot_light(5.0 * basis_towards(slanted).back, glm::dvec3(0), 0.5 * softness, 40), 2.5, angle_deg};
}

inline Scene scene_of_edge(const StraightEdge& edge) {
    return scene_of({edge.caster(), ground(0, 9)});
}

}  // namespace stairstep::made
