// Whether a frame stores its surfaces before it lights them, or lights them as it draws them (view_passes.h): by what frames
// before it counted, so that the same frames are drawn the same way each time.
//
// A fragment is a pixel of a surface that is drawn, P of F are seen in the end. Hidden ones are lit in vain when lit as drawn, and
// fragments are shaded in blocks, which a triangle's edge crosses: lanes outside it idle. Along an edge they are as many as it is
// long, so that T triangles with F fragments between them cost as much as
//
//     B = F + k √(F T)
//
// fragments in whole blocks (an upper bound where triangles differ in size, by Cauchy and Schwarz). With ℓ_i the cost of lighting a
// fragment with the i-th light or slice, in units of what storing a fragment costs, and r of reading it back:
//
//     stored = B + Σ_i P (r + ℓ_i)          drawn = B ℓ_0 + Σ_{i>0} P/F B ℓ_i + t T
//
// as later lights meet the nearest surfaces alone, in their blocks, and set all triangles up again.
//
// Anchor values, with k = 6, r = 1.25, t = 10, one light, and so few triangles that no lane idles: without overdraw, ℓ = 1.3 (none),
// drawn over stored is 1.3/3.55; with two layers over each other, ℓ = 10, it is 20/13.25.
#pragma once

#include <optional>
#include <span>

namespace stairstep {

/// What a frame counted that stored its surfaces.
struct SurfaceCounts {
    /// How often a pixel was stored, ≥ pixels.
    double fragments = 0;
    /// That show a surface.
    double pixels = 0;
    /// Drawn, whether or not anything of them was seen.
    double triangles = 0;

    bool operator==(const SurfaceCounts&) const = default;
};

/// What a frame takes that lights surfaces as they are drawn over what one takes that stores them first; 1 where nothing is
/// seen. A cost ≥ 0 a light and slice of it (ShadowTechnique::lighting_cost), at least one.
double drawn_over_stored(const SurfaceCounts& counts, std::span<const double> lighting_costs);

/// How often frames may follow one another that store nothing, and so count nothing.
inline constexpr int kMostDrawnFrames = 32;

struct SurfaceChoice {
    /// Whether this frame stores its surfaces.
    bool stored = true;
    /// Whether a frame does that can choose.
    bool storing_pays = true;
    /// Frames in a row that stored nothing, this one among them.
    int drawn_frames = 0;
    /// Of the last frame that stored its surfaces.
    std::optional<SurfaceCounts> counts;

    bool operator==(const SurfaceChoice&) const = default;
};

/// The next frame's choice: the cheaper one, where it is so by a tenth; else as before. Surfaces are stored where they `must` be,
/// while nothing is counted, and after kMostDrawnFrames.
SurfaceChoice choose_surfaces(const SurfaceChoice& last, std::span<const double> lighting_costs, bool must);

}  // namespace stairstep
