// How much of the law hangs on one observer or one texel size: c with each left out in turn.
//
// What moves ln c by more than 2/√n of its standard error, n being how many are left out one by one, is named: the bound that
// Belsley, Kuh & Welsch (1980) give DFBETAS. In n normal observers it takes one about 2 SD from the rest.
#pragma once

#include <string>
#include <vector>

#include "analysis/law/law_file.h"

namespace stairstep {

struct Influence {
    ConditionName condition;
    /// "sim03", or "5 px".
    std::string left_out;
    bool is_size = false;
    /// c without it, and that over c of all, less 1.
    double slope = 0;
    double change = 0;
    /// Change of ln c in standard errors of ln c; 0 where that is 0.
    double standard_errors = 0;
    bool is_flagged = false;
};

/// By condition, observers first, then sizes, in the order of the law.
std::vector<Influence> influences(const Law& law);

/// SVG: a panel a condition, a row what is left out, the change of c in percent; what is flagged is drawn full. Throws FailureError
/// where gnuplot can't draw.
std::string influence_figure(const Law& law, const std::vector<Influence>& influences);

/// One row each: pattern, contrast, kernel, left_out, kind ("observer" or "texel_px"), slope, change, standard_errors, flagged
/// (1 or 0).
std::string influence_csv(const std::vector<Influence>& influences);

}  // namespace stairstep
