#include "renderer/scenes/model_scene.h"

#include <algorithm>

#include "renderer/scenes/mesh_shapes.h"
#include "renderer/scenes/staging.h"

namespace stairstep {
namespace {

constexpr Direction kLight{-50, 48};
constexpr Direction kCamera{35, 24};
/// A penumbra across the whole model is then as wide as the radius on either side.
constexpr double kHalfTangent = 0.025;
constexpr double kAspect = 16.0 / 9;

}  // namespace

AnimatedScene animated_scene_from(ImportedScene imported, const std::string& name) {
    AnimatedScene animated;
    animated.name = name;
    animated.scene = std::move(imported.scene);
    const Bounds casters = caster_bounds(animated.scene);
    const glm::dvec3 middle = casters.centre();
    const double diagonal = casters.diagonal();
    animated.radius = 0.025 * diagonal;
    // What it stands for at rest is where its vertices are, so that the picture is that of the model as it came.
    for (Mesh& mesh : animated.scene.meshes) mesh.mover = 0;
    add_ground(animated.scene, 8);

    const Camera framing = framing_camera(points_of_interest(casters, kLight), kCamera, kAspect, 1, 8 * diagonal);
    Staging staging;
    staging.light = orbiting_light(kLight, 90, 0, kHalfTangent);
    staging.movers = [middle](double t) { return std::vector{turn_about(middle, 90 * t)}; };
    staging.camera = [framing, middle, diagonal](double t) {
        const glm::dmat3 turn(turn_about(glm::dvec3(0), 40 * t));
        Camera camera = framing;
        const double nearer = 1 - 0.25 * t;
        camera.eye = middle + turn * (nearer * (framing.eye - middle));
        camera.basis = {turn * framing.basis.right, turn * framing.basis.up, turn * framing.basis.back};
        // However it has turned, the model lies within half a diagonal of its middle.
        const double distance = glm::length(camera.eye - middle);
        camera.near = std::max(distance - 0.5 * diagonal, 0.01 * distance) / 2;
        return camera;
    };
    animated.state = staged(std::move(staging));
    return animated;
}

}  // namespace stairstep
