// How many texels a shadow map needs: the law turned round (Kreuzer 2017, eqs. 5.2–5.6).
//
//   texel  a = r/c             the coarsest that a filter of radius r hides
//   size   N = ceil(c·L/r)     texels across an extent L
//
// r and L share one unit: world units, or texture coordinates with L = 1. Where the screen is the finer limit,
// a = max(r/c, smallest_texel): nothing is gained by texels smaller than a pixel, and this bounds N at contacts,
// where r → 0.
//
// Anchor: c = 3.47, r = 0.4, L = 28 → 243.
#pragma once

namespace stairstep {

struct SizeRequest {
    /// c > 0, radius in texels.
    double slope = 0;
    /// r > 0, half-width of the filter's support.
    double radius = 0;
    /// L > 0, what the map spans along this axis.
    double extent = 0;
    /// Texels smaller than this are of no use (a pixel's footprint); 0 is no such limit.
    double smallest_texel = 0;
    /// No map may be larger, ≥ 1.
    int largest_size = 16384;
};

/// What decided a size.
enum class SizeLimit { law, screen, largest_size };

struct MapSize {
    /// N in [1, largest_size].
    int texels = 1;
    SizeLimit limit = SizeLimit::law;
    /// What the law and the screen alone would ask for; above `largest_size` where that was the limit.
    double texels_wanted = 1;
};

/// Throws InputError for a slope, radius or extent that is not a finite number above 0, a smallest_texel that is
/// negative or not finite, or a largest_size below 1. A quotient within 1e-12 of an integer counts as that
/// integer, so that rounding never costs a texel.
MapSize shadow_map_size(const SizeRequest& request);

}  // namespace stairstep
