// Which surface points certainly see the whole light: a quick test that spares them a thousand rays.
//
// What can hide the light from a point lies in the shaft between it and the light's square. In light space (x along the
// light's right, y along its up, depth as depth_along) the shaft of a point (x, y, z) is at depth d the square
//
//   directional   x ± (half_side/distance)·(z − d)                   for d ≤ z
//   spot          x·d/z ± half_side·(1 − d/z)                        for 0 ≤ d ≤ z
//
// and the same in y. Both ends are linear in d, so what it covers between two depths is known from the two. A tree of boxes
// around the casters' triangles is asked whether any of them meets the shaft.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/truth/world_mesh.h"

namespace stairstep {

class CasterTree {
  public:
    /// Of the meshes that cast.
    CasterTree(const std::vector<WorldMesh>& meshes, const Light& light);

    /// False only where no caster hides any of the light's square from `point`, nor from what lies within `tolerance`
    /// (world units) of it. `normal`, of unit length, is the point's facet; a triangle that rises above the facet's plane by
    /// less than half the tolerance is not in the way where the whole square is above that plane. True is no promise.
    bool may_hide_light(const glm::dvec3& point, const glm::dvec3& normal, double tolerance) const;

    /// The largest of the casters' coordinates in world space, by magnitude; 0 without casters.
    double largest_coordinate() const { return largest_coordinate_; }

  private:
    /// A box around triangles first … first + count − 1, and for count = 0 around two nodes: the next one and `second`.
    struct Node {
        Bounds box;
        uint32_t first = 0;
        uint32_t count = 0;
        uint32_t second = 0;
    };
    using Triangle = std::array<glm::dvec3, 3>;

    void build(size_t first, size_t last);
    bool square_is_above(const glm::dvec3& point, const glm::dvec3& normal) const;

    Light light_;
    /// In light space.
    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
    double largest_coordinate_ = 0;
};

}  // namespace stairstep
