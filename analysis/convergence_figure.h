// How each track went: the radius shown at every trial, the answer, and the threshold fitted afterwards.
#pragma once

#include <string>
#include <vector>

#include "analysis/law_fit.h"

namespace stairstep {

/// SVG of all tracks of one observer, a panel each, four in a row, by condition and size. `thresholds` are fitted to `tracks`.
/// A track of more than 200 trials shows every so many-th. Throws FailureError where gnuplot can't draw.
std::string convergence_figure(const std::vector<Track>& tracks, const std::vector<Threshold>& thresholds);

/// One row a trial of all tracks: observer, pattern, contrast, kernel, texel_px, trial (from 1 in the track), radius_px,
/// correct (1 or 0), threshold_px, threshold_low_px, threshold_high_px (of the whole track, 95 % credible).
std::string convergence_csv(const std::vector<Track>& tracks, const std::vector<Threshold>& thresholds);

}  // namespace stairstep
