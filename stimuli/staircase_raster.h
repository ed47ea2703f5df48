// A staircase's visibility on a raster of points, for pictures: what depends on x alone is computed once a column, what depends
// on y alone once a row, and a pixel costs a few multiplications a corner (quarter_mass.h), or a few in all for a stair under
// the box (stair_area.h). Equal to Filter::visibility but for rounding.
#pragma once

#include <algorithm>
#include <vector>

#include "stimuli/edge.h"
#include "stimuli/kernel.h"
#include "stimuli/quarter_mass.h"
#include "stimuli/stair_area.h"

namespace stairstep {

class StaircaseRaster {
  public:
    /// Whether there are closed forms for the edge and the kernel, and few enough corners under it to be worth a table.
    static bool suits(const Edge& edge, const Kernel& kernel);

    /// `xs`: the columns' places. The edge and kernel must suit.
    StaircaseRaster(const Edge& edge, const Kernel& kernel, const std::vector<double>& xs);

    class Row {
      public:
        /// V in [0, 1] at a column of the raster.
        double visibility(size_t column) const;

      private:
        friend class StaircaseRaster;
        Row(const StaircaseRaster& raster, double y);

        const StaircaseRaster& raster_;
        /// Levels of the treads from the raster's first on.
        std::vector<KernelCoordinate> treads_;
        StairLevel upper_;
        StairLevel lower_;
    };

    /// The raster must outlive its rows.
    Row row(double y) const { return Row(*this, y); }

  private:
    /// The corners under the kernel at one column: first_corner … end_corner − 1, after a tread.
    struct Column {
        size_t first_tread;
        size_t first_corner;
        size_t end_corner;
        StairSpan span;
    };

    Edge edge_;
    KernelShape shape_;
    double radius_px_;
    bool is_stair_under_box_;
    /// Number, in the edge, of the first tread under the kernel at any column, and how many there are.
    double first_tread_ = 0;
    size_t tread_count_ = 0;
    std::vector<Column> columns_;
    std::vector<KernelCoordinate> corners_;
};

// Inline: a picture asks for tens of thousands of these.
inline double StaircaseRaster::Row::visibility(size_t column_index) const {
    const Column& column = raster_.columns_[column_index];
    if (raster_.is_stair_under_box_) {
        const double a = raster_.edge_.texel_px();
        const double r = raster_.radius_px_;
        const double lit = stair_area(column.span, upper_, a) - stair_area(column.span, lower_, a);
        return std::clamp(lit / (4 * r * r), 0.0, 1.0);
    }
    const KernelShape shape = raster_.shape_;
    const KernelCoordinate* tread = &treads_[column.first_tread];
    double lit = half_mass(shape, *tread);
    for (size_t corner = column.first_corner; corner < column.end_corner; ++corner, ++tread) {
        lit -= corner_mass(shape, raster_.corners_[corner], tread[0], tread[1]);
    }
    return std::clamp(lit, 0.0, 1.0);
}

}  // namespace stairstep
