#include "stimuli/stimulus.h"

#include <algorithm>
#include <cmath>

#include "stimuli/error.h"
#include "stimuli/number.h"
#include "stimuli/visibility.h"

namespace stairstep {
namespace {

/// The least number of pixels by which the picture, moved right and up alike, falls onto itself: for edges at 45° a whole
/// number of texels. 0 where there is none.
int repeats_every(const Edge& edge, const Kernel& kernel) {
    const bool rotated = kernel.shape == KernelShape::poisson && kernel.rotated;
    if (rotated || edge.slope() != 1) return 0;
    if (edge.pattern() == Pattern::line) return 1;
    const double texel = edge.texel_px();
    return texel <= kLargestSide && texel == std::floor(texel) ? static_cast<int>(texel) : 0;
}

}  // namespace

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
    require(stimulus.kernel.radius_px >= 0 && std::isfinite(stimulus.kernel.radius_px),
            "filter radius " + format_number(stimulus.kernel.radius_px), "must be a finite number, 0 px or above",
            "use for example 35");
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

std::vector<double> luminance(const Stimulus& stimulus) {
    require_valid(stimulus);
    const Edge edge = edge_of(stimulus);
    const Filter filter(stimulus.kernel);
    const size_t width = static_cast<size_t>(stimulus.width_px);
    std::vector<double> pixels(width * stimulus.height_px);
    const int period = repeats_every(edge, stimulus.kernel);
    const bool rotated = stimulus.kernel.shape == KernelShape::poisson && stimulus.kernel.rotated;
    for (int row = stimulus.height_px - 1; row >= 0; --row) {
        double* line = &pixels[row * width];
        int computed = stimulus.width_px;
        if (period > 0 && row + period < stimulus.height_px) {
            // One period right and one up, the picture is the same.
            computed = std::min(period, stimulus.width_px);
            std::copy_n(&pixels[(row + period) * width], stimulus.width_px - computed, line + computed);
        }
        for (int column = 0; column < computed; ++column) {
            const double rotation = rotated ? rotation_at(column, row, stimulus.kernel.seed) : 0;
            line[column] = stimulus.contrast * filter.visibility(edge, pixel_centre(stimulus, column, row), rotation);
        }
    }
    return pixels;
}

int level_8bit(double luminance) {
    return static_cast<int>(std::floor(luminance * 255 + 0.5));
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
