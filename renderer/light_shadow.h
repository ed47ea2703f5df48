// One light's shadow, or that of one slice of the view: its map, how large that is, and its part of the picture.
#pragma once

#include <memory>
#include <optional>

#include "analysis/law/texel_choice.h"
#include "renderer/frame_time.h"
#include "renderer/need_meter.h"
#include "renderer/shadow_map_keeper.h"
#include "renderer/shadow_settings.h"
#include "renderer/view_passes.h"

namespace stairstep {

class LightShadow {
  public:
    /// `first` is the first state that will be drawn: with this light, and a camera that sees no more than this slice. `middle` is
    /// where a spot's constant filter has its radius. Throws as the technique's make, and FailureError.
    LightShadow(const TechniqueEntry& entry, const ShadowSettings& settings, const GpuScene& scene,
                const SceneState& first, double aspect, const glm::dvec3& middle);

    /// The map that this frame takes.
    ShadowMapShape choose(const GpuScene& scene, const SceneState& state, double aspect, int height_px);

    /// Makes a map of this shape hold the frame's casters, as far as anything visible can tell.
    void update_map(const ShadowMapShape& shape, const GpuScene& scene, const SceneState& state, gl::PassTimer& timer,
                    FrameTime& time);

    /// Lights the picture: `part` says which light and slice this is. Surfaces that are stored already aren't drawn again.
    void light(const GpuScene& scene, const SceneState& state, const DrawList& surfaces, bool stored,
               const FrameTarget& target, LightPart part, LightingPass& pass, gl::PassTimer& timer, FrameTime& time);

    const ShadowMap& map() const { return map_; }
    const ShadowTechnique& technique() const { return *technique_; }
    /// Whether its size follows what pixels need, and no frame has said yet what that is.
    bool is_unsettled() const { return meter_ && choice_.texel == 0; }
    /// Triangles of the last depth pass.
    size_t caster_triangles() const { return keeper_.triangles(); }

  private:
    /// All that a picture's visibility depends on.
    struct Seen {
        uint64_t scene = 0;
        uint64_t target = 0;
        Camera camera;
        Light light;
        std::vector<glm::dmat4> movers;
        ShadowMapShape shape;

        bool same_as(const Seen& other) const;
    };

    /// Decides whether this part's visibility is kept, and from when it can be read.
    void keep(const Seen& seen, const FrameTarget& target, LightPart& part);

    ShadowSettings settings_;
    glm::dvec3 middle_;
    std::unique_ptr<ShadowTechnique> technique_;
    ShadowMap map_;
    ShadowMapKeeper keeper_;
    std::optional<NeedMeter> meter_;
    TexelChoice choice_;
    /// What the last measured frame needed.
    std::optional<double> last_need_;

    std::optional<Seen> seen_;
    /// Visibility of the last frame, once two were the same.
    gl::Texture kept_;
    gl::Framebuffer kept_framebuffer_;
    uint64_t kept_of_target_ = 0;
    bool kept_is_filled_ = false;
};

}  // namespace stairstep
