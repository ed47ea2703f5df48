#include "stimuli/draw.h"

#include <cmath>

namespace stairstep {
namespace {

/// For edges at 45° a whole number of texels that is a whole number of pixels.
int period_of(const Edge& edge, bool rotated) {
    if (rotated || edge.slope() != 1) return 0;
    if (edge.pattern() == Pattern::line) return 1;
    const double texel = edge.texel_px();
    return texel <= kLargestSide && texel == std::floor(texel) ? static_cast<int>(texel) : 0;
}

const Stimulus& validated(const Stimulus& stimulus) {
    require_valid(stimulus);
    return stimulus;
}

}  // namespace

StimulusSampler::StimulusSampler(const Stimulus& stimulus)
    : stimulus_(validated(stimulus)),
      edge_(edge_of(stimulus)),
      filter_(stimulus.kernel),
      rotated_(stimulus.kernel.shape == KernelShape::poisson && stimulus.kernel.rotated),
      period_(period_of(edge_, rotated_)) {}

double StimulusSampler::luminance(int column, int row) const {
    const double rotation = rotated_ ? rotation_at(column, row, stimulus_.kernel.seed) : 0;
    return stimulus_.contrast * filter_.visibility(edge_, pixel_centre(stimulus_, column, row), rotation);
}

std::vector<double> luminance(const Stimulus& stimulus) {
    return draw<double>(stimulus, [](double value) { return value; });
}

}  // namespace stairstep
