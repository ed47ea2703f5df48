#include "stimuli/draw.h"

#include <algorithm>
#include <cmath>

namespace stairstep {
namespace {

bool is_whole(double value) {
    return std::abs(value - std::round(value)) < 1e-12 * std::max(1.0, std::abs(value));
}

/// A line may move by whole pixels along itself, a staircase only by whole texels: in both, where the slope is rational.
Translation period_of(const Edge& edge, const Kernel& kernel, int width_px, int height_px) {
    const bool rotated = kernel.shape == KernelShape::poisson && kernel.rotated;
    if (rotated || edge.slope() == 0) return {};
    const double unit = edge.pattern() == Pattern::line ? 1 : edge.texel_px();
    for (int units = 1; units * unit < width_px; ++units) {
        const double right = units * unit;
        const double up = units * edge.slope();  // in units
        if (is_whole(right) && is_whole(up) && is_whole(up * unit)) {
            // A block has to reach as far down as its copies come up; of very steep edges that is too far.
            const bool is_too_steep = width_px * edge.slope() > 4.0 * (width_px + height_px);
            if (is_too_steep) return {};
            return {static_cast<int>(std::lround(right)), static_cast<int>(std::lround(up * unit))};
        }
    }
    return {};
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
      period_(period_of(edge_, stimulus.kernel, stimulus.width_px, stimulus.height_px)) {
    if (LineProfile::suits(edge_, stimulus_.kernel)) profile_.emplace(edge_, stimulus_.kernel);
    if (!StaircaseRaster::suits(edge_, stimulus_.kernel)) return;
    const int columns = period_.right > 0 ? period_.right : stimulus_.width_px;
    std::vector<double> xs;
    for (int column = 0; column < columns; ++column) xs.push_back(pixel_centre(stimulus_, column, 0).x);
    raster_.emplace(edge_, stimulus_.kernel, xs);
}

double StimulusSampler::luminance(int column, int row) const {
    const double rotation = rotated_ ? rotation_at(column, row, stimulus_.kernel.seed) : 0;
    return stimulus_.contrast * filter_.visibility(edge_, pixel_centre(stimulus_, column, row), rotation);
}

double StimulusSampler::across_line(int column, int row) const {
    const Point p = pixel_centre(stimulus_, column, row);
    return stimulus_.contrast * profile_->visibility(p.y - edge_.slope() * p.x);
}

StimulusSampler::Row::Row(const StimulusSampler& sampler, int row) : sampler_(sampler), row_(row) {
    if (sampler.raster_) raster_row_.emplace(sampler.raster_->row(pixel_centre(sampler.stimulus_, 0, row).y));
}

std::vector<double> luminance(const Stimulus& stimulus) {
    return draw<double>(stimulus, [](double value) { return value; });
}

}  // namespace stairstep
