#include "stimuli/grid.h"

#include <algorithm>
#include <string>

#include "stimuli/error.h"

namespace stairstep {
namespace {

template <typename T>
void require_distinct(const char* axis, std::vector<T> values, bool may_be_empty = false) {
    if (values.empty() && !may_be_empty) throw InputError(axis, "is empty", "list at least one value");
    std::sort(values.begin(), values.end());
    if (std::adjacent_find(values.begin(), values.end()) != values.end()) {
        throw InputError(axis, "lists a value twice", "list each value once");
    }
}

/// What is drawn, and the silhouette it belongs to.
struct Shape {
    Pattern pattern;
    Pattern silhouette;
    double slope;
};

std::vector<Shape> shapes_of(const StimulusGrid& grid) {
    std::vector<Shape> sampled;
    for (const Pattern pattern : grid.patterns) {
        if (pattern == Pattern::slope) {
            for (const double slope : grid.slopes) sampled.push_back({pattern, pattern, slope});
        } else if (pattern != Pattern::line) {
            sampled.push_back({pattern, pattern, 0});
        }
    }
    if (std::find(grid.patterns.begin(), grid.patterns.end(), Pattern::line) == grid.patterns.end()) return sampled;

    std::vector<Shape> lines = sampled;
    if (lines.empty()) lines = {{Pattern::line, Pattern::step, 0}, {Pattern::line, Pattern::stair, 0}};
    for (Shape& line : lines) line.pattern = Pattern::line;
    sampled.insert(sampled.end(), lines.begin(), lines.end());
    return sampled;
}

}  // namespace

std::vector<Stimulus> stimuli_of(const StimulusGrid& grid) {
    require_distinct("patterns", grid.patterns);
    require_distinct("kernels", grid.kernels);
    require_distinct("contrasts", grid.contrasts);
    require_distinct("texel sizes", grid.texels_px);
    require_distinct("radii", grid.radii_px);

    require_distinct("slopes", grid.slopes, true);
    const bool has_slope = std::find(grid.patterns.begin(), grid.patterns.end(), Pattern::slope) != grid.patterns.end();
    if (has_slope && grid.slopes.empty()) throw InputError("slopes", "is empty", "give slope=0.3 among the patterns");
    if (grid.phases.empty()) throw InputError("phases", "is empty", "list at least one value");

    std::vector<Stimulus> stimuli;
    for (const Shape& shape : shapes_of(grid)) {
        const std::vector<Phase> phases = shape.pattern == Pattern::line ? std::vector{Phase{}} : grid.phases;
        for (const KernelShape kernel_shape : grid.kernels) {
            Kernel kernel = grid.poisson;
            kernel.shape = kernel_shape;
            for (const double contrast : grid.contrasts) {
                for (const double texel_px : grid.texels_px) {
                    for (const double radius_px : grid.radii_px) {
                        kernel.radius_px = radius_px;
                        for (const Phase& phase : phases) {
                            stimuli.push_back({shape.pattern, shape.silhouette, texel_px, kernel, contrast,
                                               grid.width_px, grid.height_px, grid.step_reference, shape.slope, phase});
                            require_valid(stimuli.back());
                        }
                    }
                }
            }
        }
    }
    return stimuli;
}

}  // namespace stairstep
