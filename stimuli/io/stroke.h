// Antialiased curves in images: what part of each pixel a pen covers.
#pragma once

#include <array>
#include <vector>

#include "stimuli/edge.h"
#include "stimuli/io/image_file.h"

namespace stairstep {

/// The share in [0, 1] of each pixel of a window that pens have covered. Where strokes meet or lie on each other the
/// greater share stays, so that they don't grow darker than one.
class Coverage {
  public:
    Coverage(int width_px, int height_px);

    /// Draws a pen of this width (≥ 1 px) along a polyline. Places are in px from the window's upper left corner, x right, y
    /// down, pixel (column, row) centred at (column + ½, row + ½); what lies outside is left out. A pixel whose centre is
    /// d from the polyline is covered by w/2 + ½ − d, limited to [0, 1]: along a straight stroke the shares add up to its
    /// length times its width to one in twenty, and their centre is its own to a tenth of a pixel.
    void stroke(const std::vector<Point>& polyline, double width_px);

    double at(int column, int row) const { return shares_[static_cast<size_t>(row) * width_ + column]; }

    /// Lays a colour over the part of an RGB image whose upper left corner is (left, top), and which lies within it, as
    /// much as each pixel is covered.
    void lay(Image& image, int left, int top, std::array<uint8_t, 3> rgb) const;

  private:
    int width_;
    int height_;
    std::vector<double> shares_;
};

}  // namespace stairstep
