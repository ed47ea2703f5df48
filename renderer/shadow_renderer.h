// Frames with shadows: what the camera sees, lit by each light through a shadow map of its own.
#pragma once

#include <string>
#include <vector>

#include "renderer/light_shadow.h"
#include "renderer/surface_choice.h"

namespace stairstep {

class ShadowRenderer {
  public:
    /// `first` is the first state that will be drawn, in a picture of this aspect. Throws as the technique's make, InputError for
    /// a warp that the technique doesn't take, and FailureError.
    ShadowRenderer(const TechniqueEntry& entry, const ShadowSettings& settings, const GpuScene& scene,
                   const SceneState& first, double aspect);

    /// Draws a frame. A map sized by what pixels need follows the last frame's; the first frame is drawn until its own
    /// needs are met. A target of several samples can't measure, and leaves the size as it is. Throws FailureError if GL
    /// reports an error.
    FrameTime draw(const GpuScene& scene, const SceneState& state, const FrameTarget& target, gl::PassTimer& timer);

    /// Draws a frame with a map of this shape for the first light, of a single slice. Maps of other lights are as in draw.
    FrameTime draw_with(const ShadowMapShape& shape, const GpuScene& scene, const SceneState& state,
                        const FrameTarget& target, gl::PassTimer& timer);

    /// The first light's map, of the nearest slice, as last drawn.
    const ShadowMap& map() const { return shadows_.front().map(); }
    const ShadowTechnique& technique() const { return shadows_.front().technique(); }
    /// All lights' slices, one light after the other.
    const std::vector<LightShadow>& shadows() const { return shadows_; }

  private:
    void match_lights(const GpuScene& scene, const SceneState& state, double aspect);
    /// One light's part of a frame, or that of one slice of it.
    struct Turn {
        /// As the light sees it.
        SceneState state;
        LightPart part;
        ShadowMapShape shape;
        Shown shown = Shown::shadow;
    };
    /// What to ask of the stored surfaces, and the turns that it is about.
    struct Asked {
        std::vector<ShadowQuestion> questions;
        std::vector<size_t> turns;
    };
    Asked questions_of(const std::vector<Turn>& turns);
    /// Finds out what the stored surfaces show of each light.
    void ask(const Asked& asked, std::vector<Turn>& turns, const GpuScene& scene, const SceneState& state,
             const FrameTarget& target);
    /// Whether this frame stores its surfaces, if it can.
    void choose_whether_to_store(const std::vector<Turn>& turns, bool asks, const GpuScene& scene,
                                 const SceneState& state, const FrameTarget& target);
    /// `again`: of a frame that was drawn before, to settle sizes.
    FrameTime draw_once(const ShadowMapShape* first_shape, bool again, const GpuScene& scene, const SceneState& state,
                        const FrameTarget& target, gl::PassTimer& timer);

    TechniqueEntry entry_;
    ShadowSettings settings_;
    /// Where spots' constant filters have their radius: the casters' middle in the first state, so that it doesn't change as they
    /// move.
    glm::dvec3 middle_;
    SurfacePass surface_pass_;
    LightingPass lighting_pass_;
    ShadowQuery query_;
    SurfaceChoice choice_;
    /// What surfaces were stored of last, and the target's count of it.
    struct Stored {
        uint64_t scene = 0;
        uint64_t target = 0;
        uint64_t count = 0;
        Camera camera;
        std::vector<glm::dmat4> movers;

        bool operator==(const Stored&) const = default;
    };
    Stored stored_;
    /// That the last stored surfaces were drawn from.
    size_t stored_triangles_ = 0;
    std::vector<LightShadow> shadows_;
};

}  // namespace stairstep
