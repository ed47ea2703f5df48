// What a shadow map makes of gaps as fine as its texels: a fence, a lattice, leaves (Kreuzer 2017, figure 6.1).
//
// A grating of period p lets light through gaps of width g, across an axis of the map. A map of texels a samples it at their
// middles and holds each sample over its texel; a box of half-width r averages that. Of the grating's harmonics m, of amplitudes
// F_m = sin(π·m·g/p)/(π·m), sampling makes all frequencies ν = m·a/p + n, in cycles a texel, n whole; holding takes sinc ν of
// each, the box sinc(2rν/a), with sinc x = sin(πx)/(πx). What should be there is n = 0, not held. So, over all phases of grating and
// texels,
//
//   rmse² = Σ F_m² · ( Σ  sinc²ν · sinc²(2rν/a)  +  (1 − sinc(m·a/p))² · sinc²(2r·m/p) )      m ≠ 0
//             m       n≠0
//
// It is large where some m·a/p comes within a/2r, a cycle over the box, of a whole number: there neighbouring gaps are all
// rounded alike, and no filter of this width averages that out. Where p is k texels exactly, each gap is drawn with ⌊g/a⌋ or
// ⌈g/a⌉ of them, and for a wide box
//
//   rmse = √(f·(1 − f)) · a/p,   f = g/a − ⌊g/a⌋,   at most a/2p
//
// A single gap of g < a, in a box far wider, raises visibility by g/2r and is drawn as 0 or as a/2r.
//
// Anchors: g = p/2, r = 3.47·a: p = a → 0.500, p = 2a → 0.036, p = 3a → 0.168, p = 7a → 0.071.
#pragma once

namespace stairstep {

/// Lengths share one unit with texels and radii.
struct Grating {
    /// 0 < gap < period.
    double gap = 0;
    double period = 0;
};

/// Root mean square of a box-filtered shadow map's visibility less the true one. `texel` > 0; `radius` ≥ texel, of the box.
/// Good to 1e-3 for periods from texel/10 to 30 times the radius. Throws InputError for numbers outside those ranges.
double grating_rmse(const Grating& grating, double texel, double radius);

}  // namespace stairstep
