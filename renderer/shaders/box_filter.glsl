// The box filter without error: every texel that the box touches counts by the area it shares with it.

// Lengths that texels first and first + 1 share with the interval from begin to end.
vec2 overlap(float first, float begin, float end) {
    vec2 side = vec2(first, first + 1);
    return clamp(min(side + 1, end) - max(side, begin), 0, 1);
}
