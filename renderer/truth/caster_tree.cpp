#include "renderer/truth/caster_tree.h"

#include <algorithm>
#include <cmath>

namespace stairstep {
namespace {

constexpr size_t kLeafSize = 4;

glm::dvec3 in_light_space(const Light& light, const glm::dvec3& point) {
    const glm::dvec3 from = light.kind == Light::Kind::spot ? point - light.position : point;
    return {glm::dot(light.basis.right, from), glm::dot(light.basis.up, from), depth_along(light, point)};
}

Bounds bounds_of(const std::array<glm::dvec3, 3>& triangle) {
    Bounds bounds;
    for (const glm::dvec3& corner : triangle) bounds.add(corner);
    return bounds;
}

/// What lies between a point and the light, in light space: at depth d a square around centre + slope·d.
struct Shaft {
    glm::dvec2 centre;
    glm::dvec2 slope;
    double half_side;
    double half_side_slope;
    double nearest;
    double farthest;

    /// Whether a box may meet it.
    bool meets(const Bounds& box) const {
        const double near = std::max(nearest, box.low.z);
        const double far = std::min(farthest, box.high.z);
        if (near > far) return false;
        for (int axis = 0; axis < 2; ++axis) {
            const double near_centre = centre[axis] + slope[axis] * near;
            const double far_centre = centre[axis] + slope[axis] * far;
            const double near_half = half_side + half_side_slope * near;
            const double far_half = half_side + half_side_slope * far;
            if (std::max(near_centre + near_half, far_centre + far_half) < box.low[axis] ||
                std::min(near_centre - near_half, far_centre - far_half) > box.high[axis]) {
                return false;
            }
        }
        return true;
    }
};

/// Wider by `tolerance` on all sides.
Shaft shaft_of(const Light& light, const glm::dvec3& point, double tolerance) {
    const glm::dvec2 across(point.x, point.y);
    if (light.kind == Light::Kind::directional) {
        const double tangent = light.half_tangent();
        return {across,   glm::dvec2(0), tangent * point.z + tolerance * (1 + tangent),
                -tangent, -INFINITY,     point.z + tolerance};
    }
    // A point that lies aside by the tolerance has a shaft that also leans and spreads otherwise.
    const double widest = std::max(std::abs(point.x), std::abs(point.y)) + light.half_side;
    return {glm::dvec2(0),
            across / point.z,
            light.half_side + tolerance * (1 + widest / point.z),
            -light.half_side / point.z,
            -tolerance,
            point.z + tolerance};
}

/// Half-space n·q ≤ offset, and whether all of a box or a triangle lies in it.
struct HalfSpace {
    glm::dvec3 normal;
    double offset;

    bool holds(const Bounds& box) const {
        const glm::dvec3 half = 0.5 * (box.high - box.low);
        return glm::dot(normal, box.centre()) + glm::dot(glm::abs(normal), half) <= offset;
    }
    bool holds(const std::array<glm::dvec3, 3>& triangle) const {
        return std::all_of(triangle.begin(), triangle.end(),
                           [&](const glm::dvec3& corner) { return glm::dot(normal, corner) <= offset; });
    }
};

}  // namespace

CasterTree::CasterTree(const std::vector<WorldMesh>& meshes, const Light& light) : light_(light) {
    for (const WorldMesh& mesh : meshes) {
        if (!mesh.casts) continue;
        for (size_t i = 0; i < mesh.triangle_count(); ++i) {
            Triangle triangle = mesh.triangle(i);
            for (glm::dvec3& corner : triangle) {
                const glm::dvec3 size = glm::abs(corner);
                largest_coordinate_ = std::max({largest_coordinate_, size.x, size.y, size.z});
                corner = in_light_space(light, corner);
            }
            triangles_.push_back(triangle);
        }
    }
    if (!triangles_.empty()) build(0, triangles_.size());
}

void CasterTree::build(size_t first, size_t last) {
    const size_t at = nodes_.size();
    nodes_.emplace_back();
    Bounds box;
    Bounds middles;
    for (size_t i = first; i < last; ++i) {
        const Bounds own = bounds_of(triangles_[i]);
        box.add(own.low);
        box.add(own.high);
        middles.add(own.centre());
    }
    nodes_[at].box = box;
    if (last - first <= kLeafSize) {
        nodes_[at].first = static_cast<uint32_t>(first);
        nodes_[at].count = static_cast<uint32_t>(last - first);
        return;
    }
    const glm::dvec3 extent = middles.high - middles.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const size_t half = (first + last) / 2;
    const auto begin = triangles_.begin();
    std::nth_element(begin + first, begin + half, begin + last, [axis](const Triangle& a, const Triangle& b) {
        return bounds_of(a).centre()[axis] < bounds_of(b).centre()[axis];
    });
    build(first, half);
    nodes_[at].second = static_cast<uint32_t>(nodes_.size());
    build(half, last);
}

bool CasterTree::square_is_above(const glm::dvec3& point, const glm::dvec3& normal) const {
    const glm::dvec3 to_light =
        light_.kind == Light::Kind::spot ? light_.position - point : light_.distance * light_.basis.back;
    const double lowered = std::abs(glm::dot(normal, light_.basis.right)) + std::abs(glm::dot(normal, light_.basis.up));
    return glm::dot(normal, to_light) > light_.half_side * lowered;
}

bool CasterTree::may_hide_light(const glm::dvec3& point, const glm::dvec3& normal, double tolerance) const {
    if (nodes_.empty()) return false;
    const glm::dvec3 place = in_light_space(light_, point);
    const Shaft shaft = shaft_of(light_, place, tolerance);
    // Depth grows against the light's back.
    const glm::dvec3 up(glm::dot(normal, light_.basis.right), glm::dot(normal, light_.basis.up),
                        -glm::dot(normal, light_.basis.back));
    const HalfSpace below{up, square_is_above(point, normal) ? glm::dot(up, place) + 0.5 * tolerance : -INFINITY};

    // Halving 2³² triangles takes 32 steps, each of which leaves one node for later.
    std::array<uint32_t, 64> waiting;
    size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
        const uint32_t at = waiting[--count];
        const Node& node = nodes_[at];
        if (!shaft.meets(node.box) || below.holds(node.box)) continue;
        if (node.count == 0) {
            waiting[count++] = node.second;
            waiting[count++] = at + 1;
            continue;
        }
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            if (shaft.meets(bounds_of(triangles_[i])) && !below.holds(triangles_[i])) return true;
        }
    }
    return false;
}

}  // namespace stairstep
