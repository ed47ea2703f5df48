// How far a scene reaches: what fitting a shadow map to it needs to know, gathered once.
#pragma once

#include <vector>

#include "renderer/scene_state.h"

namespace stairstep {

struct SceneExtents {
    /// What moves as one: what stands still first, then each mover.
    struct Part {
        /// Corners of all casting triangles, none twice.
        std::vector<glm::vec3> casters;
        /// Boxes around each mesh, caster or not.
        std::vector<Bounds> meshes;
    };
    std::vector<Part> parts;

    /// World space from part i's.
    static glm::dmat4 placement(const SceneState& state, size_t part) {
        return part == 0 ? glm::dmat4(1) : state.movers[part - 1];
    }
};

SceneExtents extents_of(const Scene& scene);

/// The corners of the convex bodies that are each of `boxes` (in `world_from_box`) cut by the planes: a point p is
/// inside where dot(plane.xyz, p) + plane.w ≥ 0. World space; empty where nothing remains.
std::vector<glm::dvec3> cut_corners(const std::vector<Bounds>& boxes, const glm::dmat4& world_from_box,
                                    const std::vector<glm::dvec4>& planes);

/// The six planes of what a camera sees, pointing inwards.
std::vector<glm::dvec4> view_planes(const Camera& camera, double aspect);

}  // namespace stairstep
