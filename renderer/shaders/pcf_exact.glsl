// Percentage-closer filtering (Reeves et al. 1987) with the box, exactly. Before it go ranges.glsl,
// box_filter.glsl, and texel_quads.glsl or texel_gather.glsl.

// Half-width of the box, texels; of a warped map, where they are smallest.
uniform vec2 filter_radius;
// A box this narrow, in texels, looks like a single texel; a narrower one's area would drown in rounding.
const float kNarrowest = 1e-3;
// 2 × 2 texels each; enough to cover the box wherever it lies.
uniform int gathers_per_side;
// Whether ranges are there; they are where the box touches no more than 8 texels.
uniform int with_ranges;
// Gathers along x that the loop takes in a step: more than one, as a step costs as much as a gather or two; few, as a pixel that
// filters nothing may pay for one step all the same (where a processor draws, a loop's body runs once with no lane in it).
const int kRun = 2;

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
    // A loop that isn't entered costs a step at most, where a branch around one may be flattened.
    int gathers = alike == 0 ? most_gathers : 0;

    // The first four texels share a corner at first + 1; textureGather returns them from the upper left clockwise.
    vec2 corner = first + 1;
    vec4 corner_depth = plane_depth(receiver, corner.x + vec4(-0.5, 0.5, 0.5, -0.5),
                                    corner.y + vec4(0.5, 0.5, -0.5, -0.5));
    float lit_area = 0;
    // One loop over rows and runs along them: where a processor draws, a loop's step costs as much as a gather or two, so that a
    // loop in a loop was slower by a half. Run by run, texels from the first four.
    vec2 offset = vec2(0);
    while (offset.y < 2 * gathers) {
        vec4 run_width = vec4(0);
        for (int i = 0; i < kRun; ++i) {
            vec2 from_first = offset + vec2(2 * i, 0);
            vec4 is_lit = lit(corner_depth + dot(receiver.slope, from_first), stored_around(corner + from_first));
            run_width += is_lit * overlap(from_first.x, begin.x, end.x).xyyx;
        }
        lit_area += dot(run_width, overlap(offset.y, begin.y, end.y).yyxx);
        offset.x += 2 * kRun;
        if (offset.x >= 2 * gathers) offset = vec2(0, offset.y + 2);
    }
    vec2 side = end - begin;
    return alike == 0 ? clamp(lit_area / (side.x * side.y), 0, 1) : float(alike > 0);
}
