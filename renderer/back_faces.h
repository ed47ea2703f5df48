// Leaving out the back faces of solids (solids.h), as they are seen from somewhere.
//
// Neither a camera's pictures nor a light's maps are mirrored: right, up and back are right-handed, and x grows to the right and
// y upwards. Movers only turn and move (scene_state.h). So front faces are counter-clockwise everywhere, OpenGL's own convention.
#pragma once

#include <span>
#include <vector>

#include "renderer/gpu_scene.h"
#include "renderer/light_frustum.h"

namespace stairstep {

/// World space: the rays of a camera begin on the hull of these points, the corners of its near plane.
std::vector<glm::dvec3> ray_starts(const Camera& camera, double aspect);

/// A spot's rays begin where it is; those of a directional light beyond all solids, nowhere.
std::vector<glm::dvec3> ray_starts(const LightFrustum& frustum);

/// Lets what this draw draws next leave out its back faces, where it is of solids none of which may hold a ray's start; else not.
void set_faces(const GpuScene::Draw& draw, const SceneState& state, std::span<const glm::dvec3> starts);

/// Draws both faces of all.
void set_both_faces();

}  // namespace stairstep
