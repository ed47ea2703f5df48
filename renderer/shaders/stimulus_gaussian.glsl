// The normal distribution of σ = ½, each axis cut at ±1.5 and renormalised.

// To 1.5e-7 (Abramowitz & Stegun 1964, 7.1.26).
float erf(float x) {
    float t = 1 / (1 + 0.3275911 * abs(x));
    float series = ((((1.061405429 * t - 1.453152027) * t + 1.421413741) * t - 0.284496736) * t + 0.254829592) * t;
    return sign(x) * (1 - series * exp(-x * x));
}

float cumulative(float x) {
    const float sqrt2 = 1.41421356;
    const float mass = 0.99730020;  // erf(3/√2): what the cut leaves
    return clamp((erf(clamp(x, -1.5, 1.5) * sqrt2) / mass + 1) / 2, 0, 1);
}

vec4 column_mass(vec2 sides) {
    return vec4(cumulative(sides.y) - cumulative(sides.x), 0, 0, 0);
}

float mass_below(vec4 column, float height) { return column.x * cumulative(height); }
