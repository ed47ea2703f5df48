// Variance shadow maps (Donnelly & Lauritzen 2006); prefiltered.glsl goes before.

// Of the casters' lit share what counts as none, and the rest is stretched (Lauritzen 2007).
uniform float bleeding_reduction;

float visibility(Receiver receiver) {
    Prefiltered around = prefiltered_around(receiver);
    if (around.casters < kNothing) return 1;
    float mean = around.mean.x;
    // No variance is known better than depths are.
    float variance = max(around.mean.y - mean * mean, around.tolerance * around.tolerance);
    float above = mean - around.height;
    // Chebyshev's inequality for one tail: no larger share of the casters can be at the receiver's height or below.
    float lit_share = above <= 0 ? 1 : variance / (variance + above * above);
    lit_share = clamp((lit_share - bleeding_reduction) / (1 - bleeding_reduction), 0, 1);
    return clamp(1 - around.casters * (1 - lit_share), 0, 1);
}
