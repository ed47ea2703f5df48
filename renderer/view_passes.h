// What the camera sees, lit through a shadow map: drawn at once, or stored first and then lit.
//
// Stored: of each pixel the plane of its nearest triangle (eye space, 32-bit floats: where the pixel's ray meets it is the
// surface point, as exact as the triangle), its normal and colour. The lighting then runs once a pixel, over whole blocks of
// pixels: no surface that another one hides is lit, and small triangles don't leave most of a block's lanes idle.
#pragma once

#include <array>
#include <string>

#include "renderer/frame_target.h"
#include "renderer/gl/program.h"
#include "renderer/gpu_scene.h"
#include "renderer/scene_state.h"
#include "renderer/techniques/technique.h"

namespace stairstep {

class SurfacePass {
  public:
    /// Throws FailureError.
    SurfacePass();

    /// Stores the nearest surfaces in a target of one sample.
    void draw(const GpuScene& scene, const SceneState& state, const FrameTarget& target) const;

  private:
    gl::Program program_;
};

class LightingPass {
  public:
    /// `name` stands for the technique in errors. Throws FailureError.
    explicit LightingPass(std::string name);

    /// Lights the surfaces that SurfacePass has stored. With a `need`, pixels write the texel they need. Throws FailureError
    /// for a shader that the driver doesn't take.
    void light_stored(const GpuScene& scene, const SceneState& state, const ShadowTechnique& technique,
                      const ShadowMap& map, const FrameTarget& target, bool need);

    /// Draws the scene and lights each surface as it is drawn.
    void draw_lit(const GpuScene& scene, const SceneState& state, const ShadowTechnique& technique,
                  const ShadowMap& map, const FrameTarget& target, bool need);

  private:
    enum class Source { drawn, stored };
    /// What maps a surface point to the map, known when a shader is compiled.
    enum class Mapping { directional, spot, warped };
    static Mapping mapping_of(const LightFrustum& frustum);
    const gl::Program& program(Source source, const ShadowTechnique& technique, Show show, Mapping mapping);

    std::string name_;
    gl::VertexArray no_vertices_;
    /// By Source, Show and Mapping; made when they are first needed.
    std::array<std::array<std::array<gl::Program, 3>, 2>, 2> programs_;
};

}  // namespace stairstep
