#include "stimuli/stimulus.h"

#include <cmath>
#include <limits>

#include "stimuli/error.h"
#include "stimuli/number.h"
#include "stimuli/visibility.h"

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
    require(stimulus.kernel.shape == KernelShape::box, "kernel " + std::string(name(stimulus.kernel.shape)),
            "has no exact visibility yet", "use box");
    require(stimulus.contrast > 0 && stimulus.contrast <= 1, "contrast " + format_number(stimulus.contrast),
            "must lie above 0 and at most at 1", "use for example 0.5");
    require(is_side(stimulus.width_px) && is_side(stimulus.height_px),
            "image size " + std::to_string(stimulus.width_px) + "x" + std::to_string(stimulus.height_px),
            "each side must be 1 to 16384 px", "use for example 640x480");
    require(stimulus.silhouette != Pattern::line, "silhouette line", "a line needs the pattern whose silhouette it is",
            "use step or stair");
}

Edge edge_of(const Stimulus& stimulus) {
    const double step_slope =
        stimulus.step_reference == StepReference::sloped ? stimulus.texel_px / stimulus.width_px : 0;
    switch (stimulus.pattern) {
        case Pattern::step: return Edge::step(stimulus.texel_px);
        case Pattern::stair: return Edge::stair(stimulus.texel_px);
        case Pattern::line: break;
    }
    return Edge::line(stimulus.silhouette == Pattern::stair ? 1 : step_slope);
}

Point pixel_centre(const Stimulus& stimulus, int column, int row) {
    return {column + 0.5 - stimulus.width_px / 2.0, stimulus.height_px / 2.0 - row - 0.5};
}

std::vector<double> luminance(const Stimulus& stimulus) {
    require_valid(stimulus);
    const Edge edge = edge_of(stimulus);
    std::vector<double> pixels;
    pixels.reserve(static_cast<size_t>(stimulus.width_px) * stimulus.height_px);
    for (int row = 0; row < stimulus.height_px; ++row) {
        for (int column = 0; column < stimulus.width_px; ++column) {
            const Point p = pixel_centre(stimulus, column, row);
            pixels.push_back(stimulus.contrast * visibility(edge, stimulus.kernel, p));
        }
    }
    return pixels;
}

int level_8bit(double luminance) {
    return static_cast<int>(std::floor(luminance * 255 + 0.5));
}

std::string file_stem(const Stimulus& stimulus) {
    const std::string shape = stimulus.pattern == Pattern::line ? "line-of-" + std::string(name(stimulus.silhouette))
                                                                : std::string(name(stimulus.pattern));
    return shape + "_" + std::string(name(stimulus.kernel.shape)) + "_a" + format_number(stimulus.texel_px) + "_r" +
           format_number(stimulus.kernel.radius_px) + "_c" + format_number(stimulus.contrast);
}

}  // namespace stairstep
