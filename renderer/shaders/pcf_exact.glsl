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

    // The first four texels share a corner at first + 1; textureGather returns them from the upper left clockwise.
    vec2 corner = first + 1;
    vec4 corner_depth = plane_depth(receiver, corner.x + vec4(-0.5, 0.5, 0.5, -0.5),
                                    corner.y + vec4(0.5, 0.5, -0.5, -0.5));
    float lit_area = 0;
    for (int j = 0; j < gathers_per_side; ++j) {
        vec2 height = overlap(2 * j, begin.y, end.y);
        for (int i = 0; i < gathers_per_side; ++i) {
            vec2 width = overlap(2 * i, begin.x, end.x);
            vec2 step_texels = 2 * vec2(i, j);
            vec4 stored = textureGather(shadow_map, (corner + step_texels) / map_size);
            vec4 is_lit = lit(corner_depth + dot(receiver.slope, step_texels), stored);
            lit_area += dot(is_lit, width.xyyx * height.yyxx);
        }
    }
    vec2 side = end - begin;
    return clamp(lit_area / (side.x * side.y), 0, 1);
}
