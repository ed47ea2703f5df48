// A technique at work: fits the light's frustum, chooses the map's size, draws the map and the picture, frame after frame.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "analysis/law/texel_choice.h"
#include "renderer/depth_pass.h"
#include "renderer/frame_target.h"
#include "renderer/gl/pass_timer.h"
#include "renderer/gpu_scene.h"
#include "renderer/need_meter.h"
#include "renderer/scene_state.h"
#include "renderer/techniques/technique.h"
#include "renderer/view_passes.h"

namespace stairstep {

/// What frames leave out because nothing of it would be seen. The picture is the same with and without.
struct Skips {
    /// The lighting of surfaces that others hide.
    bool hidden_surfaces = true;
};

struct ShadowSettings {
    TechniqueSettings technique;
    /// Half-width of a constant filter, world units across the light (at the scene's middle, for a spot), > 0.
    double radius = 0;
    /// Side of a fixed, square map; nullopt is the law's.
    std::optional<int> fixed_size;
    /// Of the law's.
    int largest_size = 8192;
    Fit fit = Fit::axis_aligned;
    /// Of a directional light's map.
    Warp warp = Warp::none;
    /// For techniques whose radius differs from pixel to pixel.
    NeedStatistic statistic;
    TexelPatience patience;
    Skips skips;
};

/// Times of a frame's passes.
struct FrameTime {
    /// The shadow map.
    gl::PassTime depth;
    /// What the technique makes of it ahead of the lighting.
    gl::PassTime prepare;
    /// What the camera sees nearest, where that is stored before it is lit.
    gl::PassTime surfaces;
    gl::PassTime lighting;
    /// What the next frame needs.
    gl::PassTime need;
    /// The fit of the frustum and the choice of the size, on the CPU, ms.
    double fit_ms = 0;

    double cpu_ms() const {
        return depth.cpu_ms + prepare.cpu_ms + surfaces.cpu_ms + lighting.cpu_ms + need.cpu_ms + fit_ms;
    }
};

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

    /// Draws a frame with a map of this shape.
    FrameTime draw_with(const ShadowMapShape& shape, const GpuScene& scene, const SceneState& state,
                        const FrameTarget& target, gl::PassTimer& timer);

    /// The map as last drawn.
    const ShadowMap& map() const { return map_; }
    const ShadowTechnique& technique() const { return *technique_; }

  private:
    ShadowMapShape choose_shape(const LightFrustum& frustum, double filter_radius, const Camera& camera, int height_px);
    ShadowMapShape fit(const GpuScene& scene, const SceneState& state, double aspect, int height_px);
    FrameTime draw_fitted(const GpuScene& scene, const SceneState& state, const FrameTarget& target,
                          gl::PassTimer& timer);

    ShadowSettings settings_;
    std::unique_ptr<ShadowTechnique> technique_;
    ShadowMap map_;
    DepthPass depth_pass_;
    SurfacePass surface_pass_;
    LightingPass lighting_pass_;
    std::optional<NeedMeter> meter_;
    TexelChoice choice_;
};

}  // namespace stairstep
