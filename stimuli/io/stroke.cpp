#include "stimuli/io/stroke.h"

#include <algorithm>
#include <cmath>

namespace stairstep {
namespace {

double distance_to_segment(Point p, Point a, Point b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double squared = dx * dx + dy * dy;
    const double along = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0;
    return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

/// First and last pixel, limited to [0, count), with a centre between two places.
std::pair<int, int> pixels_between(double low, double high, int count) {
    // Limited before they are integers: places may lie anywhere.
    const double first = std::clamp(std::ceil(low - 0.5), 0.0, static_cast<double>(count));
    const double last = std::clamp(std::floor(high - 0.5), -1.0, count - 1.0);
    return {static_cast<int>(first), static_cast<int>(last)};
}

}  // namespace

Coverage::Coverage(int width_px, int height_px)
    : width_(width_px), height_(height_px), shares_(static_cast<size_t>(width_px) * height_px) {}

void Coverage::stroke(const std::vector<Point>& polyline, double width_px) {
    const double reach = width_px / 2 + 0.5;
    for (size_t i = 1; i < polyline.size(); ++i) {
        const Point a = polyline[i - 1];
        const Point b = polyline[i];
        const auto [left, right] = pixels_between(std::min(a.x, b.x) - reach, std::max(a.x, b.x) + reach, width_);
        const auto [top, bottom] = pixels_between(std::min(a.y, b.y) - reach, std::max(a.y, b.y) + reach, height_);
        for (int row = top; row <= bottom; ++row) {
            for (int column = left; column <= right; ++column) {
                const double distance = distance_to_segment({column + 0.5, row + 0.5}, a, b);
                double& share = shares_[static_cast<size_t>(row) * width_ + column];
                share = std::max(share, std::clamp(reach - distance, 0.0, 1.0));
            }
        }
    }
}

void Coverage::lay(Image& image, int left, int top, std::array<uint8_t, 3> rgb) const {
    for (int row = 0; row < height_; ++row) {
        for (int column = 0; column < width_; ++column) {
            uint8_t* pixel = image.at(left + column, top + row);
            for (int channel = 0; channel < 3; ++channel) {
                const double mixed = pixel[channel] + at(column, row) * (rgb[channel] - pixel[channel]);
                pixel[channel] = static_cast<uint8_t>(std::lround(mixed));
            }
        }
    }
}

}  // namespace stairstep
