// Exponential shadow maps (Annen et al. 2008); prefiltered.glsl goes before.

// k, for heights in [0, 1].
uniform float exponent;

float visibility(Receiver receiver) {
    Prefiltered around = prefiltered_around(receiver);
    float casters = around.mean.x;
    if (casters < kNothing) return 1;
    float height = max(1 - receiver.depth, 0) + around.tolerance;
    // The mean of exp(k (height − h)): the factors apart would leave the range of floats.
    float lit_share = exp(min(exponent * height + log(max(around.mean.y / casters, 1e-37)), 0));
    return clamp(1 - casters * (1 - lit_share), 0, 1);
}
