// A scene whose shadows are known in closed form: boxes along the axes above a level ground, under one light.
//
// What a ray meets is the nearest of the slabs' and the ground's crossings (Kay & Kajiya 1986), in doubles; so is what hides
// the light from a point. A stage is of the size of a room and stands at the origin, its home. It is drawn at any scale and
// any distance from the world's origin, and its shadows stay what they are at home.
#pragma once

#include <optional>
#include <vector>

#include "renderer/scene_state.h"

namespace stairstep::stress {

struct Stage {
    /// All cast and receive. The first, where there is one, stands on the ground: contacts are measured at it.
    std::vector<Bounds> boxes;
    /// Of the ground, a square at y = 0 around the origin that receives; 0 for none.
    double ground_half_side = 20;
    Light light;
    Camera camera;
};

/// A box of a unit's side on the ground, a plate above, and a light 50° above the horizon whose shadows lie in view.
Stage plain_stage();

/// The same under a spot of a cone of 40°.
Stage spot_stage();

/// Where a stage is drawn: world = offset + scale · home.
struct Placement {
    glm::dvec3 offset{0};
    double scale = 1;
};

/// Its triangles at home, scaled; all belong to mover 0, which carries them to the offset.
Scene scene_of(const Stage& stage, double scale);

/// The camera, the light and the mover where the stage stands.
SceneState state_of(const Stage& stage, const Placement& placement);

/// What a ray of sight meets.
struct SeenPoint {
    glm::dvec3 position;
    /// Faces the viewer.
    glm::dvec3 normal;
    /// A number for each face of each box, and −1 for the ground.
    int face = -1;
};

/// The nearest surface along the ray from the camera's eye through a pixel's centre; nullopt where nothing is.
std::optional<SeenPoint> seen_at(const Stage& stage, int column, int row, int width, int height);

/// Whether the light's middle shines on the facet, and within a spot's cone.
bool faces_light(const Light& light, const SeenPoint& point);

/// Whether any box lies between a point and the light's point u·half_side, v·half_side of its square, u and v in [−1, 1].
bool is_hidden(const Stage& stage, const glm::dvec3& point, double u, double v);

}  // namespace stairstep::stress
