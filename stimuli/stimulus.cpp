#include "stimuli/stimulus.h"

#include <cmath>
#include <limits>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {

std::string_view name(StepReference reference) {
    return reference == StepReference::sloped ? "sloped" : "horizontal";
}

void require_valid(const Stimulus& stimulus) {
    const auto require = [](bool holds, const std::string& subject, const char* problem, const char* remedy) {
        if (!holds) throw InputError(subject, problem, remedy);
    };
    const auto is_side = [](int side) { return side >= 1 && side <= kLargestSide; };
    require(stimulus.texel_px > 0 && std::isfinite(stimulus.texel_px), "texel size " + format_number(stimulus.texel_px),
            "must be a finite number above 0 px", "use for example 10");
    require(stimulus.kernel.radius_px >= 0 && stimulus.kernel.radius_px <= std::numeric_limits<float>::max(),
            "filter radius " + format_number(stimulus.kernel.radius_px),
            "must be 0 px or above and within the range of a float", "use for example 35");
    require(stimulus.slope >= 0 && std::isfinite(stimulus.slope), "slope " + format_number(stimulus.slope),
            "must be a finite number, 0 or above", "use for example 0.5");
    require(std::isfinite(stimulus.phase.x) && std::isfinite(stimulus.phase.y), "phase",
            "must be finite numbers of texels", "use for example 0.25");
    require(stimulus.kernel.taps >= 1 && stimulus.kernel.taps <= kMostTaps,
            "poisson taps " + std::to_string(stimulus.kernel.taps), "must be 1 to 4096", "use for example 25");
    require(stimulus.contrast > 0 && stimulus.contrast <= 1, "contrast " + format_number(stimulus.contrast),
            "must lie above 0 and at most at 1", "use for example 0.5");
    require(is_side(stimulus.width_px) && is_side(stimulus.height_px),
            "image size " + std::to_string(stimulus.width_px) + "x" + std::to_string(stimulus.height_px),
            "each side must be 1 to 16384 px", "use for example 640x480");
    require(stimulus.silhouette != Pattern::line, "silhouette line", "a line needs the pattern whose silhouette it is",
            "use step, stair or slope");
}

Edge edge_of(const Stimulus& stimulus) {
    switch (stimulus.pattern) {
        case Pattern::step: return Edge::step(stimulus.texel_px, stimulus.phase);
        case Pattern::stair: return Edge::stair(stimulus.texel_px, stimulus.phase);
        case Pattern::slope: return Edge::sampled(stimulus.slope, stimulus.texel_px, stimulus.phase);
        case Pattern::line: break;
    }
    switch (stimulus.silhouette) {
        case Pattern::stair: return Edge::line(1);
        case Pattern::slope: return Edge::line(stimulus.slope);
        default: break;
    }
    const bool sloped = stimulus.step_reference == StepReference::sloped;
    return Edge::line(sloped ? stimulus.texel_px / stimulus.width_px : 0);
}

Point pixel_centre(const Stimulus& stimulus, int column, int row) {
    return {column + 0.5 - stimulus.width_px / 2.0, stimulus.height_px / 2.0 - row - 0.5};
}

std::string file_stem(const Stimulus& stimulus) {
    std::string silhouette(name(stimulus.silhouette));
    if (stimulus.silhouette == Pattern::slope) silhouette += format_number(stimulus.slope);
    std::string stem = stimulus.pattern == Pattern::line ? "line-of-" + silhouette : silhouette;
    const Kernel& kernel = stimulus.kernel;
    stem += "_" + std::string(name(kernel.shape));
    if (kernel.shape == KernelShape::poisson) {
        stem +=
            std::to_string(kernel.taps) + (kernel.rotated ? "-rotated" : "") + "-seed" + std::to_string(kernel.seed);
    }
    stem += "_a" + format_number(stimulus.texel_px) + "_r" + format_number(kernel.radius_px) + "_c" +
            format_number(stimulus.contrast);
    if (stimulus.phase != Phase{}) {
        stem += "_px" + format_number(stimulus.phase.x) + "_py" + format_number(stimulus.phase.y);
    }
    return stem;
}

}  // namespace stairstep
