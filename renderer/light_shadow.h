// One light's shadow, or that of one slice of the view: its map, how large that is, and its part of the picture.
#pragma once

#include <memory>
#include <optional>

#include "analysis/law/texel_choice.h"
#include "renderer/frame_time.h"
#include "renderer/need_meter.h"
#include "renderer/shadow_map_keeper.h"
#include "renderer/shadow_query.h"
#include "renderer/shadow_settings.h"
#include "renderer/view_passes.h"

namespace stairstep {

class LightShadow {
  public:
    /// `first` is the first state that will be drawn: with this light, and a camera that sees no more than this slice. `middle` is
    /// where a spot's constant filter has its radius. Throws as the technique's make, and FailureError.
    LightShadow(const TechniqueEntry& entry, const ShadowSettings& settings, const GpuScene& scene,
                const SceneState& first, double aspect, const glm::dvec3& middle);

    /// Distances along the view between which all that may be shadowed lies; the camera's, where nothing is.
    glm::dvec2 shadowed_range(const GpuScene& scene, const SceneState& state, double aspect) const;

    /// The map that this frame takes. A frame that is drawn again, until sizes settle, changes only those that hadn't before.
    ShadowMapShape choose(const GpuScene& scene, const SceneState& state, double aspect, int height_px, bool again);

    /// What to ask of the picture before this shape's map is drawn; nullopt where it is known, or was asked lately. What it shows
    /// is then to be told.
    std::optional<ShadowQuestion> question(const ShadowMapShape& shape, const SceneState& state, const LightPart& part);
    void answered(Shown shown) { query_patience_.answered(shown); }

    /// Makes a map of this shape hold the frame's casters, as far as anything visible can tell: nothing where no shadow is shown.
    void update_map(const ShadowMapShape& shape, Shown shown, const GpuScene& scene, const SceneState& state,
                    gl::PassTimer& timer, FrameTime& time);

    /// Whether the last frame had the same pixels, whose visibility is kept then if they are stored. `state` is the whole
    /// camera's.
    bool repeats(Shown shown, const ShadowMapShape& shape, const GpuScene& scene, const SceneState& state,
                 const FrameTarget& target) const;

    /// What lighting a fragment costs, given what the picture shows: ShadowTechnique::lighting_cost, of the map as last drawn.
    double lighting_cost(Shown shown) const {
        return shown == Shown::shadow ? technique_->lighting_cost(map_) : kUnshadowedCost;
    }

    /// Lights the picture with what it shows of the light: `part` says which light and slice this is. Surfaces that are stored already
    /// aren't drawn again.
    void light(Shown shown, const GpuScene& scene, const SceneState& state, const DrawList& surfaces, bool stored,
               const FrameTarget& target, LightPart part, LightingPass& pass, gl::PassTimer& timer, FrameTime& time);

    const ShadowMap& map() const { return map_; }
    const ShadowTechnique& technique() const { return *technique_; }
    /// Whether its size follows what pixels need, no frame before the last has said what that is, and the last did.
    bool settles() const { return meter_ && !was_settled_ && measured_; }
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

    /// Memory for maps of up to so many texels a side, and for what the technique keeps beside them.
    void reserve(int capacity);

    /// For filters that reach farther by a margin, light plane.
    LightFrustum fit(const GpuScene& scene, const SceneState& state, double aspect, double margin) const;
    static Seen seen_in(const GpuScene& scene, const SceneState& state, const FrameTarget& target,
                        const ShadowMapShape& shape);
    /// Whether pixels are compared from frame to frame.
    bool keeps() const { return settings_.skips.unchanged_pixels && technique_->reads_map(); }
    /// Decides whether this part's visibility is kept, and from when it can be read.
    void keep(const Seen& seen, bool stored, const FrameTarget& target, LightPart& part);

    ShadowSettings settings_;
    glm::dvec3 middle_;
    std::unique_ptr<ShadowTechnique> technique_;
    ShadowMap map_;
    ShadowMapKeeper keeper_;
    std::optional<NeedMeter> meter_;
    TexelChoice choice_;
    /// What the last measured frame needed.
    std::optional<double> last_need_;
    /// Before the last frame that was drawn for the first time.
    bool was_settled_ = false;
    /// Whether the last frame's needs are yet to be taken.
    bool measured_ = false;
    QueryPatience query_patience_;

    std::optional<Seen> seen_;
    /// Visibility of the last frame, once two were the same.
    gl::Texture kept_;
    gl::Framebuffer kept_framebuffer_;
    uint64_t kept_of_target_ = 0;
    bool kept_is_filled_ = false;
};

}  // namespace stairstep
