// Figures through gnuplot, run as a program: it is kept well, sets type well and writes clean SVG.
#pragma once

#include <string>

namespace stairstep {

/// Runs a script that writes to 'figure.svg' (terminal, output, axes and grid are set before it, alike for all figures) and returns the SVG.
/// Throws FailureError where gnuplot is missing or refuses the script.
std::string draw_svg(const std::string& script, int width_px, int height_px);

}  // namespace stairstep
