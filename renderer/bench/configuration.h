// What a bench compares: techniques with their filter, shadow-map sizes and taps.
//
// Names, as bench.csv has them: none · hard · pcf-exact, pcf-jittered, pcf-poisson, pcf-rotated · pcss (rotated taps, the
// classic) · pcss-levels (exact, at the level of the map where the law puts each pixel's filter) · vsm, esm · hard-lispsm and
// pcf-lispsm (exact) in a map under light_warp.h's warp, of scenes with a directional light; of a spot's they are hard and
// pcf-exact.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/light_warp.h"
#include "renderer/shadow_settings.h"
#include "renderer/techniques/technique.h"

namespace stairstep::bench {

/// What a visibility is measured against: the area light of which soft shadows are, or the filter that a technique samples,
/// converged. A box and a disk of equal variance blur alike but aren't the same.
enum class TruthKind { area_light, box_filter, disk_filter };

/// "area-light", "box-filter" or "disk-filter".
std::string_view name(TruthKind kind);

/// Side of the fixed maps that the law's are compared with, and taps of their filters and searches: common practice.
inline constexpr int kBaselineSide = 4096;
inline constexpr int kBaselineTaps = 25;

struct Configuration {
    /// As bench.csv names it.
    std::string technique;
    /// As technique_named knows it.
    std::string entry;
    FilterMode filter = FilterMode::automatic;
    /// Side of a fixed map; nullopt is the law's: for the scene's constant filter, or for pcss-levels what its pixels need.
    std::optional<int> side;
    /// Taps of the filter, and of pcss's blocker search, where they take taps; else 0.
    int taps = 0;
    Warp warp = Warp::none;
    /// What of the things that frames leave out is drawn all the same (shadow_settings.h).
    std::string no_skip = kDrawsUnchanged;

    bool operator==(const Configuration&) const = default;
};

/// "pcf-rotated 4096, 25 taps", "pcf-exact auto".
std::string label(const Configuration& configuration);

TruthKind truth_of(const Configuration& configuration);

/// What a configuration's time is divided by: 25 rotated taps over a fixed map of 4096 texels a side, of pcss for pcss's and
/// of pcf for all others'.
Configuration baseline_of(const Configuration& configuration);

/// The configurations whose pictures are shown, whose wobble is measured, and which the bars are about.
Configuration without_shadows();
Configuration auto_hard();
Configuration auto_pcf();
Configuration fixed_pcf();
Configuration auto_pcss();
Configuration fixed_pcss();

/// Whether it draws more, or less, of what frames leave out than others do: it says what that saves, and isn't on frontiers.
bool is_ablation(const Configuration& configuration);

/// The law's two that the bars are about, with one thing after another drawn that frames else leave out, then all of it, and as a
/// frame in which nothing has moved; and the fixed ones with all of it drawn, as is common practice.
std::vector<Configuration> ablations();

/// ablations() and what they are compared with.
std::vector<Configuration> ablation_configurations();

/// All techniques, hard and pcf-exact also under a warp, × {512, 1024, 2048, 4096, 8192, auto} × {9, 25, 49 taps}; none, which has no map, once.
std::vector<Configuration> all_configurations();

/// The few that answer the bars, with hard shadows and none beside them.
std::vector<Configuration> quick_configurations();

/// Bytes of the shadow maps that a configuration reserves, about.
double map_bytes(const Configuration& configuration, int largest_size);

/// Parts of `list`, in its order, of at most `most_bytes` of maps each but for one configuration of its own, and each led by the
/// baselines of its members: what is timed in turn.
std::vector<std::vector<Configuration>> groups_of(const std::vector<Configuration>& list, double most_bytes,
                                                  int largest_size);

}  // namespace stairstep::bench
