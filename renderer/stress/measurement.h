// How a technique fares under a condition.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "renderer/stress/conditions.h"
#include "renderer/stress/stage_truth.h"
#include "renderer/techniques/technique.h"

namespace stairstep::stress {

/// Visibility below this counts as darkness: a level of 255.
inline constexpr double kLeastLight = 1 - 1.0 / 255;
/// Texels from a contact within which detachment is looked for.
inline constexpr double kContactTexels = 8;

struct Measurement {
    std::string technique;
    /// Why the settings were refused, as an error's line; empty where pictures were drawn.
    std::string refusal;
    /// What GL, or the machine, said went wrong; empty where nothing did.
    std::string failure;

    /// Of visibility against the truth at pixel centres. NaN pixels count as an error of 1.
    double error_rmse = 0;
    double error_max = 0;
    /// Not in [0, 1], NaN or infinite; over all pictures drawn.
    size_t nan_pixels = 0;
    size_t gl_errors = 0;
    /// Share of the clear pixels (stage_truth.h) that come out below kLeastLight; nullopt where there is none.
    std::optional<double> acne_share;
    /// Width of the strip of false light along the first box's contact with the ground, on its shadowed side, texels: the
    /// light where the truth is fully dark, added up from the contact on, over kContactTexels. nullopt where that side is lit.
    std::optional<double> detachment_texels;
    int map_width = 0;
    int map_height = 0;

    /// Of courses alone. Largest difference, over all periods, between a frame and the one that had the same state first, once
    /// sizes had settled.
    std::optional<double> drift;
    /// The process's growth since then, KiB, and what of it came in the second half: memory that is lost again and again grows in
    /// both alike, what a driver or an allocator keeps for later only in the first.
    std::optional<double> growth_kib;
    std::optional<double> late_growth_kib;
};

struct MeasurementSettings {
    int width = 320;
    int height = 180;
    int largest_size = 4096;
};

/// What a technique of this name is measured against: pcss the area light, pcf, vsm and esm the filter, others the point.
TruthOf truth_for(const std::string& technique);

/// In the current context. `visibility` is the truth of the picture (true_visibility). Throws nothing of what a technique
/// throws: that is a result.
Measurement measure(const Condition& condition, const TechniqueEntry& entry, const MeasurementSettings& settings,
                    const std::vector<float>& visibility);

/// Of a condition's constant filter, light plane, at home.
double light_plane_radius(const Condition& condition);

/// Of the process, KiB; nullopt where /proc/self/statm can't be read.
std::optional<double> resident_kib();

}  // namespace stairstep::stress
