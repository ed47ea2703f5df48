// What the camera sees, lit through shadow maps: drawn at once, or stored first and then lit.
//
// Stored: of each pixel the plane of its nearest triangle (eye space, 32-bit floats: where the pixel's ray meets it is the
// surface point, as exact as the triangle), its normal and colour. The lighting then runs once a pixel, over whole blocks of
// pixels: no surface that another one hides is lit, and small triangles don't leave most of a block's lanes idle. Which costs less
// depends on the picture (surface_choice.h).
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "renderer/draw_list.h"
#include "renderer/frame_target.h"
#include "renderer/gl/program.h"
#include "renderer/gl/sample_counter.h"
#include "renderer/techniques/technique.h"

namespace stairstep {

/// What shaders/surface_stored.glsl needs to know where pixels look.
void set_ray_uniforms(const gl::Program& program, const Camera& camera, const FrameTarget& target);

class SurfacePass {
  public:
    /// Throws FailureError.
    SurfacePass();

    /// Stores the nearest of the surfaces in a target of one sample.
    void draw(const GpuScene& scene, const SceneState& state, const DrawList& surfaces, const FrameTarget& target);

    /// How often it has stored a pixel since the last call: what a nearer surface then covered, too. Nullopt if it hasn't drawn.
    std::optional<uint64_t> take_fragments() { return fragments_.take(); }

  private:
    gl::SampleCounter fragments_;
    /// Of materials without and with a texture: looking one up costs as much as all the rest.
    std::array<gl::Program, 2> programs_;
};

/// One light's part of a picture.
struct LightPart {
    /// Its place among the lights: the first brings the sky, the others add to it.
    size_t index = 0;
    size_t count = 1;
    /// Only what lies so far along the view, from the first to just below the second.
    std::optional<glm::dvec2> slice;
    /// Whether pixels write the texel they need; for targets of one sample.
    bool need = false;
    /// Where visibility is known: nothing casts a shadow that is seen, or it is read from `kept`, as it was when it was written.
    enum class Visibility { computed, all_lit, kept } visibility = Visibility::computed;
    GLuint kept = 0;
    /// What stored surfaces are lit into, if not the target's own.
    GLuint framebuffer = 0;
};

class LightingPass {
  public:
    /// `name` stands for the technique in errors. Throws FailureError.
    explicit LightingPass(std::string name);

    /// Lights the surfaces that SurfacePass has stored with `state.light`. Throws FailureError for a shader that the driver doesn't
    /// take.
    void light_stored(const GpuScene& scene, const SceneState& state, const ShadowTechnique& technique,
                      const ShadowMap& map, const FrameTarget& target, const LightPart& part);

    /// Draws the surfaces and lights each as it is drawn.
    void draw_lit(const GpuScene& scene, const SceneState& state, const DrawList& surfaces,
                  const ShadowTechnique& technique, const ShadowMap& map, const FrameTarget& target,
                  const LightPart& part);

    /// How many stored pixels it has lit with the first light since the last call: all slices' together. Nullopt if there was
    /// no such pass.
    std::optional<uint64_t> take_pixels() { return pixels_.take(); }

  private:
    enum class Source { drawn, drawn_textured, stored };
    /// How places and depths in the map follow from places in the world.
    enum class Mapping { directional, warped, spot, linear_spot };
    static Mapping mapping_of(const LightFrustum& frustum);

    struct Key {
        Source source;
        Show show;
        Mapping mapping;
        bool sliced;
        /// What decides visibility, by where its text is.
        std::vector<const char*> technique;

        auto operator<=>(const Key&) const = default;
    };
    const gl::Program& program(Source source, const ShadowTechnique& technique, const ShadowMap& map, Show show,
                               const LightPart& part);

    std::string name_;
    gl::VertexArray no_vertices_;
    gl::SampleCounter pixels_;
    /// Made when they are first needed.
    std::map<Key, gl::Program> programs_;
};

}  // namespace stairstep
