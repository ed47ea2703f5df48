// What `stairstep-render image` draws: a model on a ground, framed and lit, or a scene as it is staged.
#pragma once

#include "renderer/image_job.h"
#include "renderer/scene_state.h"

namespace stairstep {

/// What the picture is of.
struct Staged {
    Scene scene;
    SceneState state;
    /// Without the ground of a model.
    size_t triangles = 0;
    Bounds casters;
    double radius = 0;
};

/// Reads or makes what the job names; `aspect` is the picture's width over its height. Throws InputError.
Staged stage(const ImageJob& job, double aspect);

}  // namespace stairstep
