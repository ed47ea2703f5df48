// Variance shadow maps (Donnelly & Lauritzen 2006); prefiltered.glsl goes before.

// Of the casters' lit share what counts as none, and the rest is stretched (Lauritzen 2007).
uniform float bleeding_reduction;

float visibility(Receiver receiver) {
    Prefiltered around = prefiltered_around(receiver);
    float casters = around.mean.x;
    if (casters < kNothing) return 1;
    float height = max(1 - receiver.depth, 0) + around.tolerance;
    float mean = around.mean.y / casters;
    // No variance is known better than depths are.
    float variance = max(around.mean.z / casters - mean * mean, around.tolerance * around.tolerance);
    float above = mean - height;
    // Chebyshev's inequality for one tail: no larger share of the casters can be at the receiver's height or below.
    float lit_share = above <= 0 ? 1 : variance / (variance + above * above);
    lit_share = clamp((lit_share - bleeding_reduction) / (1 - bleeding_reduction), 0, 1);
    return clamp(1 - casters * (1 - lit_share), 0, 1);
}
