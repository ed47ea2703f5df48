#include "stimuli/edge.h"

#include <cmath>
#include <string>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

void require(bool holds, const char* subject, double value, const char* problem, const char* remedy) {
    if (!holds) throw InputError(subject + (" " + format_number(value)), problem, remedy);
}

void require_grid(double texel_px, Phase phase) {
    require(texel_px > 0 && std::isfinite(texel_px), "texel size", texel_px, "must be a finite number above 0 px",
            "use for example 10");
    require(std::isfinite(phase.x), "phase", phase.x, "must be a finite number of texels", "use for example 0.25");
    require(std::isfinite(phase.y), "phase", phase.y, "must be a finite number of texels", "use for example 0.25");
}

void require_slope(double slope) {
    require(slope >= 0 && std::isfinite(slope), "slope", slope, "must be a finite number, 0 or above",
            "use for example 0.5");
}

}  // namespace

std::string_view name(Pattern pattern) {
    switch (pattern) {
        case Pattern::step: return "step";
        case Pattern::stair: return "stair";
        case Pattern::slope: return "slope";
        case Pattern::line: return "line";
    }
    return "";
}

Edge Edge::step(double texel_px, Phase phase) {
    require_grid(texel_px, phase);
    return Edge(Pattern::step, texel_px, 0, {phase.x, phase.y});
}

Edge Edge::stair(double texel_px, Phase phase) {
    require_grid(texel_px, phase);
    return Edge(Pattern::stair, texel_px, 1, phase);
}

Edge Edge::sampled(double slope, double texel_px, Phase phase) {
    require_grid(texel_px, phase);
    require_slope(slope);
    return Edge(Pattern::slope, texel_px, slope, phase);
}

Edge Edge::line(double slope) {
    require_slope(slope);
    return Edge(Pattern::line, 0, slope, {});
}

}  // namespace stairstep
