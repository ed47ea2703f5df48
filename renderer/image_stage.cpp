#include "renderer/image_stage.h"

#include "renderer/scene_import.h"
#include "renderer/scenes/scenes.h"
#include "stimuli/error.h"
#include "stimuli/io/program.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

double checked_radius(double radius, const Bounds& casters) {
    // Written so that NaN fails. Beyond the model's own size the map would be all margin.
    if (radius > 0 && radius <= casters.diagonal()) return radius;
    throw InputError("--radius " + format_number(radius), "must be above 0 and at most the model's diagonal",
                     "use one up to " + format_fixed(casters.diagonal(), 3) + " world units");
}

/// A light whose square is seen under another angle.
Light resized(Light light, const std::optional<double>& half_tangent) {
    if (half_tangent) light.half_side = *half_tangent * light.distance;
    return light;
}

Staged stage_model(const ImageJob& job, double aspect) {
    ImportedScene imported = import_scene(job.scene);
    for (const std::string& warning : imported.warnings) warn(job.scene.c_str(), warning.c_str());
    Staged staged;
    staged.scene = std::move(imported.scene);
    staged.triangles = triangle_count(staged.scene);
    staged.casters = caster_bounds(staged.scene);
    const double diagonal = staged.casters.diagonal();
    staged.radius = checked_radius(job.radius.value_or(0.025 * diagonal), staged.casters);
    add_ground(staged.scene, 8);
    const Direction light = job.light.value_or(Direction{-50, 48});
    staged.state.light = directional_light(light, job.light_half_tangent.value_or(0.05));
    staged.state.camera =
        framing_camera(points_of_interest(staged.casters, light), job.camera.value_or(Direction{35, 24}), aspect,
                       job.camera_distance, 8 * diagonal);
    return staged;
}

Staged stage_scene(const ImageJob& job, double aspect) {
    AnimatedScene animated = scene_named(job.scene);
    Staged staged;
    staged.scene = std::move(animated.scene);
    staged.triangles = triangle_count(staged.scene);
    staged.state = animated.state(Motion::still, 0);
    staged.casters = caster_bounds(staged.scene, staged.state);
    staged.radius = checked_radius(job.radius.value_or(animated.radius), staged.casters);
    if (job.light) staged.state.light = directional_light(*job.light, staged.state.light.half_tangent());
    staged.state.light = resized(staged.state.light, job.light_half_tangent);
    if (job.camera) {
        const Direction light = direction_of(staged.state.light.basis.back);
        staged.state.camera = framing_camera(points_of_interest(staged.casters, light), *job.camera, aspect,
                                             job.camera_distance, 8 * staged.casters.diagonal());
    }
    return staged;
}

}  // namespace

Staged stage(const ImageJob& job, double aspect) {
    return scene_unless_file(job.scene) ? stage_scene(job, aspect) : stage_model(job, aspect);
}

}  // namespace stairstep
