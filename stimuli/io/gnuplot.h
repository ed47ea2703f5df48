// Figures through gnuplot, run as a program: it is kept well, sets type well and writes clean SVG.
#pragma once

#include <string>

namespace stairstep {

/// Runs a script that writes to 'figure.svg' (terminal, output, axes and grid are set before it, alike for all figures) and returns the SVG.
/// Throws FailureError where gnuplot is missing or refuses the script.
std::string draw_svg(const std::string& script, int width_px, int height_px);

/// "gnuplot 5.4 patchlevel 4", what draw_svg runs. Throws FailureError where gnuplot is missing.
std::string gnuplot_version();

}  // namespace stairstep
