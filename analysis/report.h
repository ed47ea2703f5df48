// report.html: one self-contained page, readable without a network; beside it each figure as SVG and its data as CSV.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/law_fit.h"
#include "analysis/reference_points.h"
#include "analysis/report_methods.h"
#include "analysis/study_check.h"

namespace stairstep {

/// What to show beside the fit; an empty path leaves its section out.
struct ReportInputs {
    /// A PNG.
    std::string contact_sheet{};
    /// stats.json of stairstep-render; pictures are looked for beside it.
    std::string render_stats{};
    StudyBackground background{};
    /// What reference filter sizes are of where the background has no design.
    PictureSize picture{};
    StudyCheckOptions check{};
};

struct Report {
    /// report.html.
    std::string html;
    /// Name and content of each other file: law.svg, law.csv, thresholds.csv, reference.csv, psychometric.svg,
    /// psychometric-observers.svg, psychometric.csv, psychometric-fits.csv, convergence-01.svg … (one an observer, in the order of
    /// first trials), convergence.csv, residuals.svg, residuals.csv, influence.svg, influence.csv, sensitivity.csv, checks.csv,
    /// comparisons.csv, criteria.csv, estimates.csv, methods.txt.
    std::vector<std::pair<std::string, std::string>> files;
};

/// `trials` are those that `fit` is of. Throws InputError for an input that is missing or isn't what it should be, and
/// FailureError where gnuplot can't draw. The same inputs give the same bytes, whatever the number of threads.
Report make_report(const std::vector<Trial>& trials, const LawFit& fit, const ReportInputs& inputs);

}  // namespace stairstep
