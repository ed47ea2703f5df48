// Drawing a stimulus pixel by pixel, each value computed no more often than it must be.
//
// Edges never fall, so visibility never rises from left to right, nor from top to bottom: below the last row that is lit all
// over and above the first that is dark lie the only rows to look at, and where a row's two ends have the same value, so have
// all between; it is halved until its parts are flat. An edge of rational slope falls onto itself when it moves along
// itself: one block as wide as that translation holds all values of the picture, and the rest is copied. Neither needs to know
// the kernel. Staircases, besides, are tabulated by column and row (staircase_raster.h), and what lies across a line is a
// function of one number (line_profile.h).
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "stimuli/line_profile.h"
#include "stimuli/staircase_raster.h"
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

/// The exact values of a stimulus' pixels.
class StimulusSampler {
  public:
    /// Throws as `require_valid`.
    explicit StimulusSampler(const Stimulus& stimulus);

    /// C·V at the centre of a single pixel, in [0, C].
    double luminance(int column, int row) const;

    /// One row of pixels, faster than one by one.
    class Row {
      public:
        double luminance(int column) const {
            if (raster_row_) return sampler_.stimulus_.contrast * raster_row_->visibility(column);
            return sampler_.profile_ ? sampler_.across_line(column, row_) : sampler_.luminance(column, row_);
        }

      private:
        friend class StimulusSampler;
        Row(const StimulusSampler& sampler, int row);

        const StimulusSampler& sampler_;
        int row_;
        std::optional<StaircaseRaster::Row> raster_row_;
    };

    /// Where there is a period, only the first `period().right` columns can be asked of a row, and rows may lie above or
    /// below the picture. The sampler must outlive its rows.
    Row row(int row) const { return Row(*this, row); }

    /// The least translation by whole pixels under which the picture falls onto itself, {0, 0} where there is none within
    /// its width or it is so steep that nothing is gained by it.
    Translation period() const { return period_; }

    /// Whether values never rise along rows and columns; not so where each pixel turns the kernel by its own angle.
    bool is_monotone() const { return !rotated_; }

  private:
    double across_line(int column, int row) const;

    Stimulus stimulus_;
    Edge edge_;
    Filter filter_;
    bool rotated_;
    Translation period_;
    /// For staircases, and for lines.
    std::optional<StaircaseRaster> raster_;
    std::optional<LineProfile> profile_;
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

/// The least row in [0, rows) for which `is_below` holds, or rows; it holds for all rows below one for which it does.
template <typename IsBelow>
int first_row(int rows, const IsBelow& is_below) {
    int low = 0;
    int high = rows;
    while (low < high) {
        const int middle = low + (high - low) / 2;
        is_below(middle) ? high = middle : low = middle + 1;
    }
    return low;
}

/// A block of pixels whose values never rise along rows and columns, between `lit` and `dark`, row by row. `pixels_of(row)`
/// gives a function of the column. Made in `storage`.
template <typename Pixel, typename PixelsOf>
std::vector<Pixel> falling_block(int width, int rows, Pixel lit, Pixel dark, const PixelsOf& pixels_of,
                                 std::vector<Pixel> storage) {
    std::vector<Pixel> block = std::move(storage);
    block.assign(static_cast<size_t>(width) * rows, dark);
    const int end_lit = first_row(rows, [&](int row) { return pixels_of(row)(width - 1) != lit; });
    const int begin_dark = first_row(rows, [&](int row) { return pixels_of(row)(0) == dark; });
    std::fill_n(block.begin(), static_cast<size_t>(width) * end_lit, lit);
    for (int row = end_lit; row < begin_dark; ++row) {
        Pixel* line = &block[static_cast<size_t>(row) * width];
        const auto pixel_at = pixels_of(row);
        line[0] = pixel_at(0);
        line[width - 1] = pixel_at(width - 1);
        fill_falling(line, 0, width, pixel_at);
    }
    return block;
}

/// A picture that falls onto itself under `period`, out of a block of its first `period.right` columns that goes on below the
/// picture's last row for as many rows as the last column needs. Made in `storage`.
template <typename Pixel>
std::vector<Pixel> repeated(const std::vector<Pixel>& block, Translation period, int width, int height,
                            std::vector<Pixel> storage) {
    std::vector<Pixel> pixels = std::move(storage);
    pixels.resize(static_cast<size_t>(width) * height);
    // From the bottom up, so that the row to copy from is there already.
    for (int row = height - 1; row >= 0; --row) {
        Pixel* line = &pixels[static_cast<size_t>(row) * width];
        const Pixel* source = &block[static_cast<size_t>(row) * period.right];
        if (row + period.up < height) {
            std::copy_n(source, period.right, line);
            std::copy_n(line + static_cast<size_t>(period.up) * width, width - period.right, line + period.right);
            continue;
        }
        for (int column = 0; column < width; column += period.right) {
            std::copy_n(source, std::min(period.right, width - column), line + column);
            source += static_cast<size_t>(period.up) * period.right;
        }
    }
    return pixels;
}

/// All pixels, row by row from the top. `quantise` turns luminance in [0, 1] into a pixel and may not turn a smaller
/// luminance into a larger pixel. Whoever draws many hands in the last one's pixels as `storage`: the memory of a picture costs
/// more to come by than its values.
template <typename Pixel, typename Quantise>
std::vector<Pixel> draw(const Stimulus& stimulus, const Quantise& quantise, std::vector<Pixel> storage = {}) {
    const StimulusSampler sampler(stimulus);
    const int width = stimulus.width_px;
    const int height = stimulus.height_px;
    const auto pixels_of = [&](int row) {
        return [&quantise, pixels = sampler.row(row)](int column) {
            return static_cast<Pixel>(quantise(pixels.luminance(column)));
        };
    };
    if (!sampler.is_monotone()) {
        std::vector<Pixel> pixels = std::move(storage);
        pixels.resize(static_cast<size_t>(width) * height);
        for (int row = 0; row < height; ++row) {
            const auto pixel_at = pixels_of(row);
            for (int column = 0; column < width; ++column) {
                pixels[static_cast<size_t>(row) * width + column] = pixel_at(column);
            }
        }
        return pixels;
    }
    const auto lit = static_cast<Pixel>(quantise(stimulus.contrast));
    const auto dark = static_cast<Pixel>(quantise(0.0));
    const Translation period = sampler.period();
    if (period.right == 0) return falling_block(width, height, lit, dark, pixels_of, std::move(storage));
    const int block_rows = height + (width - 1) / period.right * period.up;
    return repeated(falling_block(period.right, block_rows, lit, dark, pixels_of, {}), period, width, height,
                    std::move(storage));
}

}  // namespace stairstep
