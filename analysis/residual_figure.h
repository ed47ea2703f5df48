// What the psychometric functions leave: deviance residuals against the predicted share of right answers, where a wrong sigmoid or
// law shows, and against the trial's number, where learning and tiring show.
//
// A single answer's residual is one of two numbers and says little. So each observer's answers in a condition are grouped, by
// prediction or by order, into groups of nearly equal size, and a group of n answers with k right and mean prediction Ψ̄ has
//
//   d = sign(k/n − Ψ̄)·√(2·[k·ln(k/(nΨ̄)) + (n − k)·ln((n − k)/(n − nΨ̄))])
//
// which is about normal with SD 1 where the function holds (a little less where predictions within the group differ).
#pragma once

#include <string>
#include <vector>

#include "analysis/study_check.h"

namespace stairstep {

enum class ResidualOrder { prediction, trial };

struct ResidualGroup {
    std::string observer;
    ConditionName condition;
    ResidualOrder order = ResidualOrder::prediction;
    /// Mean prediction, or mean number of the trial in the condition, from 1.
    double position = 0;
    int trials = 0;
    int right = 0;
    /// nΨ̄.
    double expected = 0;
    /// d.
    double residual = 0;
};

/// Groups of about this many answers.
constexpr int kResidualGroupSize = 16;
/// Groups whose residual is farther from 0 are named.
constexpr double kLargeResidual = 3;

/// Of all curves that could be fitted, in their order; the groups of a curve and order have all its answers, each once.
std::vector<ResidualGroup> residual_groups(const StudyCheck& check);

/// SVG: a column a condition, by prediction on top and by trial below; lines are means over observers. Throws
/// FailureError where gnuplot can't draw.
std::string residual_figure(const StudyCheck& check, const std::vector<ResidualGroup>& groups);

/// One row a group: observer, pattern, contrast, kernel, order ("prediction" or "trial"), position, trials, right, expected,
/// residual.
std::string residuals_csv(const std::vector<ResidualGroup>& groups);

}  // namespace stairstep
