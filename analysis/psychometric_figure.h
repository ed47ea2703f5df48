// Psychometric functions with their data: the share of right answers against stimulus strength.
//
// Answers are put into bins of equal width and each bin is drawn at the mean strength of its answers, as a disk whose area is
// in proportion to their number, with Wilson's interval (binomial_interval.h). Within a condition observers are pooled at
// strengths aligned on each one's own law, log10(c_j·a/r), so that 0 is everybody's threshold; unaligned, a mean of curves that
// lie apart is flatter than any of them.
#pragma once

#include <string>
#include <vector>

#include "analysis/study_check.h"

namespace stairstep {

struct ResponseBin {
    /// Mean of the strengths in it, log10 units.
    double strength = 0;
    int trials = 0;
    int right = 0;
    /// What was shown and said, for the share of "artifact" among either.
    ResponseCounts counts;
};

/// log10 units: pooled over a condition, where there are many trials, and for one observer.
constexpr double kPooledBinWidth = 0.06;
constexpr double kObserverBinWidth = 0.12;
/// An outermost bin of fewer trials joins its neighbour: far from the threshold, where trials are few, the curve is flat.
constexpr int kLeastInPooledBin = 12;
constexpr int kLeastInObserverBin = 6;

/// Bins of one width with edges at multiples of it, ascending, without empty ones, the outermost joined to their neighbours until
/// they have `least` trials: their counts sum to the trials. strengths[i] is that of trials[i], finite (asserted).
std::vector<ResponseBin> binned(const std::vector<double>& strengths, const std::vector<Trial>& trials, double width,
                                int least);

/// All aligned trials of one condition.
std::vector<ResponseBin> pooled_bins(const StudyCheck& check, const ConditionName& condition);
/// One observer's trials in one condition, at strengths log10(a/r).
std::vector<ResponseBin> observer_bins(const ObserverCurve& curve);

/// SVG: a column a condition; the share of right answers with the fitted curve, and where the task is yes-no the share of "artifact"
/// below, of artifacts and of lines. Throws FailureError where gnuplot can't draw.
std::string pooled_psychometric_figure(const StudyCheck& check);

/// SVG: a panel an observer and condition, a row an observer, against log10(a/r).
std::string observer_psychometric_figure(const StudyCheck& check);

/// One row a bin of both figures: pattern, contrast, kernel, observer (empty for pooled), aligned (1 or 0), strength, trials,
/// right, right_low, right_high (Wilson's 95 %), artifacts, hits, lines, false_alarms, fitted (the curve's share at `strength`,
/// empty where nothing was fitted).
std::string psychometric_csv(const StudyCheck& check);

/// One row a curve: observer, pattern, contrast, kernel, trials, right, threshold (log10(a/r)), threshold_px_per_texel (r/a),
/// threshold_low, threshold_high (95 %, profile likelihood; empty where unbounded), steepness, lapse, lapse_low, lapse_high, deviance,
/// deviance_p, residual_with_prediction, residual_with_prediction_p, residual_with_order, residual_with_order_p,
/// influential_trials, remark (what couldn't be estimated, and why).
std::string psychometric_fits_csv(const StudyCheck& check);

}  // namespace stairstep
