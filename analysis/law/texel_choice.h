// Which texel a shadow map gets as what it needs changes from frame to frame.
//
// Texels come on a ladder of eight to the octave, 2^k·{8, 9, … 15}/8: numbers of four significant bits, so that a texel's
// place in the light plane is exact, and fine enough that rounding down to one costs at most 1/8 along an axis. A finer
// texel is taken at once; a coarser one only after it would have done for a while, and by more than a rung, as each change
// moves every step in every silhouette (Kreuzer 2017, section 6.2: wobble).
#pragma once

namespace stairstep {

/// The largest texel of the ladder that isn't above `needed`, which must be above 0 and finite.
double texel_on_ladder(double needed);

struct TexelChoice {
    /// 0 before the first choice.
    double texel = 0;
    /// For how many frames in a row a coarser one would have done, and the finest of those that were needed.
    int frames_coarser = 0;
    double finest_needed = 0;

    bool operator==(const TexelChoice&) const = default;
};

struct TexelPatience {
    /// A coarser texel is considered from this factor on.
    double dead_band = 1.25;
    /// After this many frames.
    int frames = 30;
};

/// The choice for a frame that needs texels of `needed` or finer, given the last frame's. Never above texel_on_ladder(needed).
/// The same need again and again settles on one texel for good; needs that wander within the dead band change nothing but,
/// once, towards the finer end. An infinite need (nothing needs the map) counts as a coarser one and keeps the texel.
/// `needed` is above 0.
TexelChoice choose_texel(const TexelChoice& previous, double needed, const TexelPatience& patience = {});

}  // namespace stairstep
