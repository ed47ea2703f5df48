// The reference filter sizes of many artifacts, as a table and as a plot beside a study's law.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stimuli/reference.h"

namespace stairstep {

/// One artifact (its radius means nothing) and the radii, px, from which on it looks like its line.
struct ReferenceSizes {
    Stimulus artifact;
    std::optional<double> one_level;
    std::optional<double> half_level;
    std::optional<double> identical;
};

/// The sizes of all artifacts, computed on `jobs` threads (0: one a core) with a progress bar. Throws as reference_radius.
std::vector<ReferenceSizes> reference_sizes(const std::vector<Stimulus>& artifacts, double largest_radius_px, int jobs);

/// CSV: pattern, slope, kernel, contrast, texel_px, width_px, height_px, step_reference, largest_radius_px, then
/// one_level_px, half_level_px, identical_px, each empty where it isn't reached.
std::string reference_csv(const std::vector<ReferenceSizes>& sizes, double largest_radius_px);

/// A study's threshold r = slope·a to draw beside them.
struct StudyLaw {
    Pattern pattern;
    double contrast;
    KernelShape kernel;
    double slope;
};

/// SVG: radius against texel size, a panel a kernel and contrast (Kreuzer 2017, figure 4.6); sizes within one level as points
/// and lines, the study's laws dashed.
std::string reference_figure(const std::vector<ReferenceSizes>& sizes, const std::vector<StudyLaw>& laws);

}  // namespace stairstep
