// Exponential shadow maps (Annen et al. 2008); prefiltered.glsl goes before.

// k, for heights in [0, 1].
uniform float exponent;

float visibility(Receiver receiver) {
    Prefiltered around = prefiltered_around(receiver);
    if (around.casters < kNothing) return 1;
    // The mean of exp(k (height − h)) over the casters: the factors apart would leave the range of floats.
    float lit_share = exp(min(exponent * around.height + log(max(around.mean.x, 1e-37)), 0));
    return clamp(1 - around.casters * (1 - lit_share), 0, 1);
}
