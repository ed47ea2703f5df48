#include "stimuli/staircase_raster.h"

#include <algorithm>

namespace stairstep {
namespace {

constexpr double kMostCorners = 4096;

}  // namespace

bool StaircaseRaster::suits(const Edge& edge, const Kernel& kernel) {
    if (edge.pattern() == Pattern::line || kernel.shape == KernelShape::poisson || kernel.radius_px == 0) return false;
    return edge.pattern() == Pattern::step ||
           support(kernel.shape) * kernel.radius_px < kMostCorners * edge.texel_px() / 2;
}

StaircaseRaster::StaircaseRaster(const Edge& edge, const Kernel& kernel, const std::vector<double>& xs)
    : edge_(edge),
      shape_(kernel.shape),
      radius_px_(kernel.radius_px),
      is_stair_under_box_(kernel.shape == KernelShape::box && edge.pattern() == Pattern::stair) {
    const double reach = support(shape_) * radius_px_;
    if (xs.empty()) return;
    const auto [left, right] = std::minmax_element(xs.begin(), xs.end());
    first_tread_ = edge_.column(*left - reach);
    tread_count_ = static_cast<size_t>(edge_.column(*right + reach) - first_tread_) + 1;
    columns_.reserve(xs.size());
    for (const double x : xs) {
        const double first = edge_.column(x - reach);
        const double last = edge_.column(x + reach);
        const size_t first_corner = corners_.size();
        if (!is_stair_under_box_) {
            for (double tread = first + 1; tread <= last; ++tread) {
                corners_.push_back(kernel_coordinate(shape_, (edge_.column_begin(tread) - x) / radius_px_));
            }
        }
        columns_.push_back({static_cast<size_t>(first - first_tread_), first_corner, corners_.size(),
                            StairSpan(edge_, x - reach, x + reach)});
    }
}

StaircaseRaster::Row::Row(const StaircaseRaster& raster, double y)
    : raster_(raster), upper_(raster.edge_, y + raster.radius_px_), lower_(raster.edge_, y - raster.radius_px_) {
    if (raster.is_stair_under_box_) return;
    treads_.reserve(raster.tread_count_);
    for (size_t i = 0; i < raster.tread_count_; ++i) {
        const double height = raster.edge_.column_height(raster.first_tread_ + static_cast<double>(i));
        treads_.push_back(kernel_coordinate(raster.shape_, (height - y) / raster.radius_px_));
    }
}

}  // namespace stairstep
