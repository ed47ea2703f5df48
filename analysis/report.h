// report.html: one self-contained page, readable without a network.
#pragma once

#include <string>
#include <vector>

#include "analysis/law_fit.h"

namespace stairstep {

/// Results of the other stages to show beside the fit; an empty path leaves its section out.
struct ReportInputs {
    /// A PNG.
    std::string contact_sheet;
    /// stats.json of stairstep-render; pictures are looked for beside it.
    std::string render_stats;
    /// What the observers are, for example "simulated"; empty where that isn't known.
    std::string observer_kind{};
};

/// The page as text. Throws InputError for an input that is missing or isn't what it should be, and FailureError where
/// gnuplot can't draw.
std::string report_html(const std::vector<Trial>& trials, const LawFit& fit, const ReportInputs& inputs);

}  // namespace stairstep
