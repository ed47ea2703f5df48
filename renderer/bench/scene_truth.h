// The truths of a scene that techniques are measured against, kept on disk.
//
// area_light is traced (truth/area_light_truth.h). A filter's truth is the filter itself, converged: a map of many texels
// under many taps of the same kernel, drawn in the current context.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "renderer/bench/configuration.h"
#include "renderer/shadow_renderer.h"

namespace stairstep::bench {

/// Changes whenever the same converged filter would come out otherwise, so that stored ones are known to be old.
inline constexpr int kFilterTruthVersion = 1;

struct TruthSettings {
    /// Of the area light, a square number.
    int light_samples = 1024;
    /// Of a converged filter: side of its map, and taps, a square number.
    int filter_side = 8192;
    int filter_taps = 4096;
    std::filesystem::path cache;
    /// Threads that trace, 0 for one a core.
    int jobs = 0;
};

/// "1024 rays a pixel", "4096 taps over 8192 x 8192 texels".
std::string describe(TruthKind kind, const TruthSettings& settings);

class SceneTruth {
  public:
    /// For pictures of this size, px. `radius` is that of constant filters, as ShadowSettings'. Scenes outlive it.
    SceneTruth(const Scene& scene, const GpuScene& gpu_scene, double radius, const TruthSettings& settings, int width,
               int height);

    /// Row by row from the top. Throws FailureError.
    std::vector<float> visibility(TruthKind kind, const SceneState& state);

  private:
    std::vector<float> draw_filter(TruthKind kind, const SceneState& state);

    const Scene& scene_;
    const GpuScene& gpu_scene_;
    double radius_;
    TruthSettings settings_;
    int width_;
    int height_;
    /// By kind; made when first needed, since a map of the size takes memory and time.
    std::array<std::optional<ShadowRenderer>, 3> converged_;
    std::optional<FrameTarget> target_;
};

}  // namespace stairstep::bench
