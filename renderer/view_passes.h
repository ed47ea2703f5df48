// What the camera sees: which surface is nearest, and that surface lit through a shadow map.
#pragma once

#include <array>
#include <string>

#include "renderer/frame_target.h"
#include "renderer/gl/program.h"
#include "renderer/gpu_scene.h"
#include "renderer/scene_state.h"
#include "renderer/techniques/technique.h"

namespace stairstep {

/// A pass over the depths alone, after which the lighting's costly shader runs for no surface that another one hides.
class ViewDepthPass {
  public:
    /// Throws FailureError.
    ViewDepthPass();

    /// Clears the target's depths and draws the scene's.
    void draw(const GpuScene& scene, const SceneState& state, const FrameTarget& target) const;

  private:
    gl::Program program_;
};

class LightingPass {
  public:
    /// `name` stands for the technique in errors.
    explicit LightingPass(std::string name) : name_(std::move(name)) {}

    struct Options {
        /// Whether the target holds the depths of ViewDepthPass already.
        bool depths_are_there = false;
        /// Whether pixels write the texel they need; for targets of one sample.
        bool with_need = false;
    };

    /// Draws the scene as the camera sees it, lit through the technique. Throws FailureError for a shader that the driver
    /// doesn't take.
    void draw(const GpuScene& scene, const SceneState& state, const ShadowTechnique& technique, const ShadowMap& map,
              const FrameTarget& target, const Options& options);

  private:
    const gl::Program& program(const ShadowTechnique& technique, Show show, Light::Kind light);

    std::string name_;
    /// By what is shown and the light's kind; made when they are first needed.
    std::array<std::array<gl::Program, 2>, 2> programs_;
};

}  // namespace stairstep
