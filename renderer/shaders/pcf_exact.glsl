// Percentage-closer filtering (Reeves et al. 1987) with the box, exactly; ranges.glsl and box_filter.glsl go before.

// Half-width of the box, texels; of a warped map, where they are smallest.
uniform vec2 filter_radius;
// A box this narrow, in texels, looks like a single texel; a narrower one's area would drown in rounding.
const float kNarrowest = 1e-3;
// 2 × 2 texels each; enough to cover the box wherever it lies.
uniform int gathers_per_side;
// Whether ranges are there; they are where the box touches no more than 8 texels.
uniform int with_ranges;

float visibility(Receiver receiver) {
    vec2 radius = warped ? max(filter_radius * receiver.scale, kNarrowest) : filter_radius;
    vec2 low = receiver.texel - radius;
    vec2 first = floor(low);
    // The box counted from its first texel: small numbers keep their precision.
    vec2 begin = low - first;
    vec2 end = begin + 2 * radius;

    int most_gathers = gathers_per_side;
    if (warped) most_gathers = min(most_gathers, int(ceil(max(end.x, end.y) / 2)));
    int alike = with_ranges != 0 ? all_alike(receiver, first, vec2(2 * most_gathers), vec2(kGuard)) : 0;
    // A loop that isn't entered costs nothing, where a branch around one may be flattened.
    int gathers = alike == 0 ? most_gathers : 0;

    // The first four texels share a corner at first + 1; textureGather returns them from the upper left clockwise.
    vec2 corner = first + 1;
    vec4 corner_depth = plane_depth(receiver, corner.x + vec4(-0.5, 0.5, 0.5, -0.5),
                                    corner.y + vec4(0.5, 0.5, -0.5, -0.5));
    float lit_area = 0;
    for (int j = 0; j < gathers; ++j) {
        vec2 height = overlap(2 * j, begin.y, end.y);
        for (int i = 0; i < gathers; ++i) {
            vec2 width = overlap(2 * i, begin.x, end.x);
            vec2 step_texels = 2 * vec2(i, j);
            vec4 stored = stored_around(corner + step_texels);
            vec4 is_lit = lit(corner_depth + dot(receiver.slope, step_texels), stored);
            lit_area += dot(is_lit, width.xyyx * height.yyxx);
        }
    }
    vec2 side = end - begin;
    return alike == 0 ? clamp(lit_area / (side.x * side.y), 0, 1) : float(alike > 0);
}
