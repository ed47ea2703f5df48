// How often intervals for the law's slope hold the truth, and how far off the slope is: counted over simulated studies.
//
// Each cell changes one thing about a usual study (10 observers, between-observer SD .16, β 3.5, lapses .02, 40 trials a track,
// texels of 5, 10, 20 and 30 px, the step at full contrast): how many observers, how much they differ, how they lapse, how
// steep they are, how many sizes or trials there are, whether thresholds deviate from the law. The planted slope is the
// median observer's. An interval of 95 % should hold it in .93 to .97 of studies; with 1,000 studies a share is known to
// ± .014.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/law_fit.h"
#include "analysis/planted_study.h"

namespace stairstep {

struct CoverageCell {
    /// What differs from the usual study: "20 observers".
    std::string name;
    PlantedStudy study;
};

/// The usual study, then each variation. `design` gives engine, task, sizes and trials; patterns and contrasts are the usual
/// study's, and the cells about sizes and trials replace the design's.
std::vector<CoverageCell> usual_cells(const Design& design = {});

/// One interval method in one cell.
struct MethodCoverage {
    /// As SlopeEstimate::name.
    std::string method{};
    /// Over the studies that could be fitted.
    int studies = 0;
    /// Share of intervals that hold the planted slope, and its standard error.
    double coverage = 0;
    double coverage_se = 0;
    /// Mean of ln(estimate/planted) and its standard error; SD of the same between studies.
    double bias = 0;
    double bias_se = 0;
    double sd = 0;
    /// Mean width of ln of the interval.
    double width = 0;

    /// Whether the share lies in .93 to .97, or could for all that so many studies tell (two standard errors).
    bool is_on_target() const;
};

/// One entry for each method that any study has estimates by, in the order of their first. A study without estimates could not
/// be fitted.
std::vector<MethodCoverage> count_coverage(const std::vector<std::vector<SlopeEstimate>>& studies, double true_slope);

struct CellCoverage {
    std::string cell;
    std::vector<MethodCoverage> methods;
    /// Studies from which no law could be fitted.
    int failed = 0;
};

struct CoverageSettings {
    /// Studies a cell, ≥ 2.
    int studies = 1000;
    uint64_t seed = 1;
    /// Threads, 0 for one a core; the result doesn't depend on it.
    int jobs = 0;
    double p_threshold = 0.82;
    /// Replicates for interval methods that need them; 0 leaves those out.
    int replicates = 0;
};

/// `done` is called, from any thread, after each study.
CellCoverage coverage_of(
    const CoverageCell& cell, const CoverageSettings& settings, const std::function<void()>& done = [] {});

}  // namespace stairstep
