// Drawing a stimulus pixel by pixel, each value computed no more often than it must be.
//
// Two things are true of every edge that never falls. Along a row visibility never rises from left to right, so where a
// row's two ends have the same value, all between have it too: a row is halved until its parts are flat. And an edge of
// rational slope falls onto itself when it moves along itself, so most of the picture is a copy. Neither needs to know the
// kernel.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "stimuli/stimulus.h"
#include "stimuli/visibility.h"

namespace stairstep {

/// A way to make luminances: as luminance() of stimulus.h, width × height values in [0, C], row by row from the top; a
/// function of the stimulus alone.
using LuminanceOf = std::function<std::vector<double>(const Stimulus&)>;

/// A translation in pixels, right and up.
struct Translation {
    int right = 0;
    int up = 0;
};

/// The exact value of single pixels of a stimulus.
class StimulusSampler {
  public:
    /// Throws as `require_valid`.
    explicit StimulusSampler(const Stimulus& stimulus);

    /// C·V at the centre of a pixel, in [0, C].
    double luminance(int column, int row) const;

    /// The least translation by whole pixels under which the picture falls onto itself; {0, 0} where there is none within
    /// its width.
    Translation period() const { return period_; }

    /// Whether values never rise along a row; not so where each pixel turns the kernel by its own angle.
    bool falls_along_rows() const { return !rotated_; }

  private:
    Stimulus stimulus_;
    Edge edge_;
    Filter filter_;
    bool rotated_;
    Translation period_;
};

/// Fills row[begin … end − 1], whose first and last pixel are there already, by halves.
template <typename Pixel, typename PixelAt>
void fill_falling(Pixel* row, int begin, int end, const PixelAt& pixel_at) {
    const int last = end - 1;
    if (last - begin < 2) return;
    if (row[begin] == row[last]) {
        std::fill(row + begin + 1, row + last, row[begin]);
        return;
    }
    const int middle = begin + (last - begin) / 2;
    row[middle] = pixel_at(middle);
    fill_falling(row, begin, middle + 1, pixel_at);
    fill_falling(row, middle, end, pixel_at);
}

/// All pixels, row by row from the top. `quantise` turns luminance in [0, 1] into a pixel and may not turn a smaller
/// luminance into a larger pixel.
template <typename Pixel, typename Quantise>
std::vector<Pixel> draw(const Stimulus& stimulus, const Quantise& quantise) {
    const StimulusSampler sampler(stimulus);
    const int width = stimulus.width_px;
    const int height = stimulus.height_px;
    const Translation period = sampler.period();
    std::vector<Pixel> pixels(static_cast<size_t>(width) * height);
    // From the bottom up, so that the row to copy from is there already.
    for (int row = height - 1; row >= 0; --row) {
        Pixel* line = &pixels[static_cast<size_t>(row) * width];
        int fresh = width;
        if (period.up > 0 && row + period.up < height) {
            fresh = period.right;
            std::copy_n(line + static_cast<size_t>(period.up) * width, width - fresh, line + fresh);
        }
        const auto pixel_at = [&](int column) { return static_cast<Pixel>(quantise(sampler.luminance(column, row))); };
        if (sampler.falls_along_rows()) {
            line[0] = pixel_at(0);
            line[fresh - 1] = pixel_at(fresh - 1);
            fill_falling(line, 0, fresh, pixel_at);
        } else {
            for (int column = 0; column < fresh; ++column) line[column] = pixel_at(column);
        }
    }
    return pixels;
}

}  // namespace stairstep
