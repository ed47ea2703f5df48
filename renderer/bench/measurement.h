// What one configuration costs and how far off it is, in one scene.
//
// Configurations are timed in turn, frame by frame, so that whatever else the machine does slows each alike; what memory can't
// hold at once is timed in groups, each with the baseline in it. Times are medians; time_ratio is the median over rounds of a
// frame's time over that of the baseline's frame in the same round, in which slow drifts cancel.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bench/configuration.h"
#include "renderer/bench/scene_truth.h"
#include "renderer/bench/timed_renderer.h"
#include "renderer/comparison.h"

namespace stairstep::bench {

struct MeasurementSettings {
    /// Of the picture, px.
    int width = 1280;
    int height = 720;
    /// Timed of each configuration, ≥ 1, after those in which its map's size settles.
    int frames = 10;
    /// c of the box.
    double law_slope = 3.47;
    /// Most texels a side of the law's maps.
    int largest_size = 8192;
    /// Of shadow maps at once, unless one configuration needs more.
    double most_map_bytes = 2.0 * 1024 * 1024 * 1024;
};

/// |ΔV − ΔV_true| (comparison.h) over a scene's motions; see wobble.h.
struct MotionWobble {
    double light = 0;
    double caster = 0;
    double camera = 0;

    double mean() const { return (light + caster + camera) / 3; }
};

struct Measurement : MedianTimes {
    Configuration configuration;
    /// Of the map as last drawn; 0 where the technique reads none.
    int width = 0;
    int height = 0;
    std::string limited_by;
    ShadowTechnique::Lookups lookups;

    /// Against the baseline's frames.
    double time_ratio = 1;

    /// Of visibility at pixel centres, against the configuration's own kind of truth.
    VisibilityError error;
    /// Between the two shown as pictures, in levels of 255.
    double rmse_levels = 0;
    /// Visibility, kept of the configurations whose pictures are shown.
    std::vector<float> visibility;

    /// Where it was measured.
    std::optional<MotionWobble> wobble;
    /// Of those with the same family of truths: area lights, and filters.
    bool on_frontier = false;
    /// What dominates it, by its place among the scene's measurements.
    std::optional<size_t> dominator;

    double texels() const { return static_cast<double>(width) * height; }
};

/// Left out, and why, for people.
using Notes = std::vector<std::string>;

/// `truth` gives the visibility that a kind of configuration should have. Exact filters wider than 128 texels are left out
/// with a note. `advance` is called for each configuration done. Measurements are in the order of `list`, without wobble and
/// frontier. Throws FailureError, and InputError for what a technique can't take.
std::vector<Measurement> measure(const std::vector<Configuration>& list, const MeasurementSettings& settings,
                                 const Subject& subject,
                                 const std::function<const std::vector<float>&(TruthKind)>& truth, Notes& notes,
                                 const std::function<void()>& advance);

/// A renderer for one configuration whose map has the size at which it settles.
ShadowRenderer settled_renderer(const Configuration& configuration, const MeasurementSettings& settings,
                                const Subject& subject, const FrameTarget& target);

/// Sets on_frontier and dominator by frame time and error, for techniques measured against the area light and for those
/// measured against their filters separately: errors against different truths say nothing of each other.
void find_frontiers(std::vector<Measurement>& measurements);

/// A frame's time, ms, as its ratio to the baseline has it: configurations of different groups weren't timed in turn, and the machine
/// may have been slower in one. As it was where the baseline isn't there.
double steady_ms(const std::vector<Measurement>& measurements, const Measurement& one);

/// The measurement of a configuration; nullptr where it isn't there.
const Measurement* find(const std::vector<Measurement>& measurements, const Configuration& configuration);

}  // namespace stairstep::bench
