// The box filter without error: every texel that the box touches counts by the area it shares with it.

// Half-width of the box, texels.
uniform vec2 filter_radius;
// 2 × 2 texels each; enough to cover the box wherever it lies.
uniform int gathers_per_side;

// Lengths that texels first and first + 1 share with the interval from begin to end.
vec2 overlap(float first, float begin, float end) {
    vec2 side = vec2(first, first + 1);
    return clamp(min(side + 1, end) - max(side, begin), 0, 1);
}

float visibility(Receiver receiver) {
    vec2 map_size = vec2(textureSize(shadow_map, 0));
    vec2 low = receiver.texel - filter_radius;
    vec2 first = floor(low);
    // The box counted from its first texel: small numbers keep their precision.
    vec2 begin = low - first;
    vec2 end = begin + 2 * filter_radius;

    float lit_area = 0;
    for (int j = 0; j < gathers_per_side; ++j) {
        vec2 height = overlap(2 * j, begin.y, end.y);
        for (int i = 0; i < gathers_per_side; ++i) {
            vec2 width = overlap(2 * i, begin.x, end.x);
            // The corner that four texels share; textureGather returns them from the upper left clockwise.
            vec2 corner = first + vec2(2 * i, 2 * j) + 1;
            vec4 stored = textureGather(shadow_map, corner / map_size);
            vec2 offset = corner - receiver.texel;
            vec4 is_lit = lit(receiver, offset.x + vec4(-0.5, 0.5, 0.5, -0.5),
                              offset.y + vec4(0.5, 0.5, -0.5, -0.5), stored);
            lit_area += dot(is_lit, width.xyyx * height.yyxx);
        }
    }
    return clamp(lit_area / (4 * filter_radius.x * filter_radius.y), 0, 1);
}
