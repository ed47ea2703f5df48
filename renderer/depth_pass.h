// The depth pass: casters as the light sees them.
#pragma once

#include "renderer/gl/program.h"
#include "renderer/gpu_scene.h"
#include "renderer/scene_state.h"
#include "renderer/shadow_map.h"

namespace stairstep {

class DepthPass {
  public:
    /// Throws FailureError.
    DepthPass();

    /// Draws the casters into the map, and empties the guard around it.
    void draw(const GpuScene& scene, const SceneState& state, const ShadowMap& map) const;

  private:
    gl::Program program_;
};

}  // namespace stairstep
