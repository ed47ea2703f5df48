// What a picture shows of a light: a shadow, its light alone, or nothing. Asked of the stored surfaces (view_passes.h), before the
// light's map is drawn: a lamp behind a wall needs none.
//
// The answer may say "a shadow" where there is none, and never the reverse. A pixel's surface point p with the facet normal n may lie
// in shadow if it faces the light, is within a spot's cone, and some caster lies, in the light plane, within R of p's own place
// (R: how far the technique looks, along the map's axes right and up, and two texels) on the light's side of p's plane. Techniques
// compare stored depths with the plane's depth at the texel they are stored for, so no other caster can darken p. For casters in a box
// B this holds only if
//
//   the line p + t·l towards the light meets B, widened by the square of R, at some t ≥ −R (|n·right| + |n·up|)/(n·l), and
//   some corner of B is on the light's side of the plane.
//
// A spot's R is a tangent: widths are R times the depth of the box's far end. R grows with the receiver's depth z_p above the nearest
// box's z_b where penumbrae do (light.h): by softness·(z_p − z_b), or softness·(1/z_b − 1/z_p) for a spot. Boxes hold 256 triangles
// or more (caster_boxes.h), so that what is exact of the rays is rough of the casters.
//
// Bounds of the points and normals of 8 × 8 pixels come first, and tell most tiles that a light doesn't reach; then each pixel of the
// others. Looks at each 256th and each 16th pixel go before: most lights that throw a shadow are found there. The answer is waited for.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "renderer/caster_boxes.h"
#include "renderer/frame_target.h"
#include "renderer/gl/program.h"
#include "renderer/light_frustum.h"

namespace stairstep {

/// What of a light a picture shows. `shadow`: some surface may lie in one. `light`: it reaches surfaces, all of them whole.
enum class Shown { shadow, light, nothing };

struct ShadowQuestion {
    Light light;
    /// As it was fitted for the frame; not its warp.
    LightFrustum frustum;
    /// R where it doesn't grow with depth, light plane, ≥ 0.
    double reach = 0;
    /// How R grows, for each world unit (directional) or unit of reciprocal depth (spot), ≥ 0.
    double softness = 0;
    /// Whether its technique may look anywhere: whatever it lights may be in shadow, if there is a caster.
    bool looks_anywhere = false;
    /// Of the view, as LightPart::slice.
    std::optional<glm::dvec2> slice;
};

class ShadowQuery {
  public:
    /// Throws FailureError.
    ShadowQuery();

    /// An answer a question, of the surfaces that `target`, of one sample, has stored. Waits for the GPU.
    std::vector<Shown> ask(const GpuScene& scene, const SceneState& state, const FrameTarget& target,
                           std::span<const ShadowQuestion> questions);

  private:
    /// What a look finds, tile by tile.
    struct Tiles {
        glm::ivec2 count{0};
        /// Lowest and highest point and normal.
        std::array<gl::Texture, 4> bounds;
        gl::Framebuffer bounds_framebuffer;
        /// A number a tile and light, of so many lights.
        gl::Texture answers;
        gl::Framebuffer answers_framebuffer;
        size_t lights = 0;

        void reserve(const glm::ivec2& wanted_count, size_t wanted_lights);
    };

    /// The index-th of kLooks.
    std::vector<Shown> look(size_t index, const Camera& camera, const FrameTarget& target,
                            std::span<const ShadowQuestion> questions, const std::vector<TurnedBox>& casters);

    gl::Program tiles_program_;
    gl::Program query_program_;
    gl::VertexArray no_vertices_;
    std::array<Tiles, 3> tiles_;
    /// Of the scene with this serial.
    std::vector<CasterBox> boxes_;
    uint64_t boxes_of_ = 0;
};

/// When to ask about a light again: one that shows nothing of its shadow each frame, another after 1, 2, 4 … 16 frames.
class QueryPatience {
  public:
    /// Once a frame.
    bool is_due() { return wait_ == 0 || --wait_ == 0; }
    void answered(Shown shown);

  private:
    int wait_ = 0;
    int next_wait_ = 1;
};

}  // namespace stairstep
