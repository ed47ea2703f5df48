// The depth pass: casters as the light sees them.
#pragma once

#include "renderer/draw_list.h"
#include "renderer/gl/program.h"
#include "renderer/shadow_map.h"

namespace stairstep {

class DepthPass {
  public:
    /// Throws FailureError.
    DepthPass();

    /// Empties the map and the guard around it.
    void clear(const DepthMap& memory, const ShadowMapShape& shape) const;

    /// Draws casters into the map.
    void draw(const GpuScene& scene, const SceneState& state, const DrawList& casters, const DepthMap& memory,
              const ShadowMapShape& shape);

  private:
    gl::Program program_;
    /// For a spot's linear depths; made when it is first needed.
    gl::Program linear_program_;
};

}  // namespace stairstep
