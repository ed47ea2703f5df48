// Cascaded shadow maps (Engel 2006; Zhang et al. 2006): the view is cut across into slices, each with a map of its own.
//
// The slices' borders C_i lie along the view between near and far (Zhang et al. 2006):
//
//   uniform       n + (i/N)(f − n)
//   logarithmic   n·(f/n)^(i/N)
//   practical     their mean
//
// Under the law all slices have the same texels, on one grid, wherever the radius decides: a texel is r/c however much the map
// covers. So there is no seam, and what a fixed size spends on the nearest slice isn't spent. Where a pixel's footprint decides,
// farther slices get larger texels.
#pragma once

#include <string>
#include <vector>

namespace stairstep {

enum class Splits { uniform, logarithmic, practical };

/// Throws InputError that lists the names there are.
Splits splits_named(const std::string& name);

struct Cascades {
    /// In [1, 16]; 1 is a single map.
    int count = 1;
    Splits splits = Splits::practical;
};

/// The count + 1 borders, from near to far; 0 < near < far. Four slices of 1 to 100 by practical splits: 1, 14.5, 30.25, 53.4, 100.
std::vector<double> split_distances(double near, double far, const Cascades& cascades);

}  // namespace stairstep
