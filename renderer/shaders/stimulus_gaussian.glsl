// The normal distribution of σ = ½, each axis cut at ±1.5 and renormalised.

// To 1.5e-7 (Abramowitz & Stegun 1964, 7.1.26).
vec2 erf(vec2 x) {
    vec2 t = 1 / (1 + 0.3275911 * abs(x));
    vec2 series = ((((1.061405429 * t - 1.453152027) * t + 1.421413741) * t - 0.284496736) * t + 0.254829592) * t;
    return sign(x) * (1 - series * exp(-x * x));
}

vec2 cumulative(vec2 x) {
    const float sqrt2 = 1.41421356;
    const float mass = 0.99730020;  // erf(3/√2): what the cut leaves
    return clamp((erf(clamp(x, -1.5, 1.5) * sqrt2) / mass + 1) / 2, 0, 1);
}

float mass_below(vec2 column, float height) {
    vec2 side = cumulative(column);
    return (side.y - side.x) * cumulative(vec2(height)).x;
}
