// Percentage-closer soft shadows on levels of the map: each pixel filters at the coarsest one that the law allows its
// radius, exactly, so that its cost is bounded however wide the penumbra, and without noise.
//
// The mean depth of what blocks is taken where the filter will look. A search as wide as a penumbra can be sees blockers
// that stand too far aside for their depth: over a crease the far ends of its walls, which would widen the filter until it
// takes in the near ones. So the search only says how wide to look again, and the mean over that box decides the radius.
//
// A level of factor f is what a map of f times the texel would hold: the depth at the centre of each of its texels. Factors
// are 1, 2, 3, 4, 6, 8, 12 …; an even one's texel centres lie on the finest map's where its grid is moved by half a texel
// of that. ranges.glsl and box_filter.glsl go before.

layout(binding = 2) uniform sampler2D levels;
uniform vec2 levels_scale;  // 1 / size of the texture
// Where a level's texel (0, 0) lies, and its size.
uniform vec4 level_place[24];
uniform int level_count;
// Whether ranges are there.
uniform int with_ranges;

// Half-width of a penumbra's filter, texels, for each unit between the stored depths of receiver and caster.
uniform vec2 softness;
// c: half-width in texels of the narrowest filter that hides its texels.
uniform float law_slope;
// Half-width of the search, in texels of its level, at most; half a texel more is looked at.
uniform float search_radius;
// A look near by is on a level this much finer.
uniform int nearer_levels;
// Texels of the estimate, in those of the filter, at most.
uniform float estimate_texel;

// What a pixel looks for in the map: blockers as far off as any can be; how deep they are within the penumbra they would
// throw; and the share of the light that they hide. The first time it finds nothing, what it looked at may have been too
// coarse for what is small and near: it looks once more near by, and goes on from there.
const int kWide = 0;
const int kNear = 1;
const int kEstimate = 2;
const int kFilter = 3;

// A share of a box that is rounding's.
const float kNothing = 1e-5;

float factor_of(int level) { return level == 0 ? 1 : (level % 2 == 1 ? 1.0 : 1.5) * exp2(float((level + 1) / 2)); }

// The last level whose factor is at most this.
int level_within(float factor) {
    int octave = int(floor(log2(max(factor, 1))));
    int level = octave == 0 ? 0 : 2 * octave - 1 + int(factor >= 1.5 * exp2(float(octave)));
    return min(level, level_count - 1);
}

// The first level whose factor is at least this.
int level_beyond(float factor) {
    int level = level_within(factor);
    return min(level + int(factor_of(level) < factor), level_count - 1);
}

Receiver on_level(Receiver receiver, int level) {
    float factor = factor_of(level);
    receiver.texel = (receiver.texel - (level == 0 || level == 2 ? 0.0 : 0.5)) / factor;
    receiver.slope *= factor;
    return receiver;
}

// What lies over the box of this half-width, texels of the level, and blocks the receiver: its share of the box's area, and
// the sum of its depths, each by its share.
vec2 blocked_and_depth(Receiver receiver, int level, vec2 radius) {
    vec4 place = level_place[level];
    // Counted from the first texel, and as wide as it is: small numbers keep their precision.
    vec2 low = receiver.texel - radius;
    vec2 first = clamp(floor(low), vec2(0), place.zw);
    vec2 begin = low - first;
    // Beyond the map nothing blocks; a box may be far larger than the map.
    vec2 end = clamp(begin + 2 * radius, vec2(0), place.zw - first);
    begin = max(begin, vec2(0));
    ivec2 gathers = ivec2(ceil(end / 2 - 1e-6));

    // All lit: nothing to add up. A loop that isn't entered costs a step at most, where a branch around one may be flattened.
    bool in_window = with_ranges != 0 && max(gathers.x, gathers.y) <= 4;
    if (in_window && all_alike(receiver, first, 2 * vec2(gathers), place.xy) > 0) gathers = ivec2(0);

    // The first four texels share a corner at first + 1; textureGather returns them from the upper left clockwise.
    vec2 corner = first + 1;
    vec4 corner_depth = plane_depth(receiver, corner.x + vec4(-0.5, 0.5, 0.5, -0.5),
                                    corner.y + vec4(0.5, 0.5, -0.5, -0.5));
    vec2 sum = vec2(0);
    for (int j = 0; j < gathers.y; ++j) {
        vec2 height = overlap(2 * j, begin.y, end.y);
        for (int i = 0; i < gathers.x; ++i) {
            vec2 width = overlap(2 * i, begin.x, end.x);
            vec2 step_texels = 2 * vec2(i, j);
            vec4 stored = textureGather(levels, (place.xy + corner + step_texels) * levels_scale);
            vec4 is_lit = lit(corner_depth + dot(receiver.slope, step_texels), stored);
            vec4 blocked = (1 - is_lit) * width.xyyx * height.yyxx;
            sum += vec2(blocked.x + blocked.y + blocked.z + blocked.w, dot(blocked, stored));
        }
    }
    return sum / (4 * radius.x * radius.y);
}

// The texel that the law allows a radius, light plane.
float texel_for(vec2 radius) { return min(radius.x * texel_side.x, radius.y * texel_side.y) / law_slope; }

float visibility(Receiver receiver) {
    int look = kWide;
    // Casters lie beyond depth 0: none further off to the side can be in the way.
    vec2 radius = max(softness * receiver.depth, 0.5);
    int level = level_beyond(max(radius.x, radius.y) / search_radius);
    bool looked_near = false;
    float blocked = 0;
    // One loop around one look, as pixels that stop early then cost nothing for the looks they don't take.
    while (look <= kFilter) {
        // A texel's centre may lie up to half a texel beyond what it stands for.
        float margin = look == kFilter ? 0.0 : 0.5;
        vec2 found = blocked_and_depth(on_level(receiver, level), level, radius / factor_of(level) + margin);
        blocked = found.x;
        if (blocked < kNothing) {
            if (looked_near || level == 0) return 1;
            looked_near = true;
            look = kNear;
            level = max(level - nearer_levels, 0);
            radius = min(radius, search_radius * factor_of(level));
            continue;
        }
        if (look >= kEstimate && blocked > 1 - kNothing) return 0;
        if (look == kFilter) break;
        look = look == kEstimate ? kFilter : kEstimate;
        // At contacts a texel's width is what the map can show.
        radius = max(softness * (receiver.depth - found.y / found.x), 0.5);
        float texel = texel_for(radius) * (look == kEstimate ? estimate_texel : 1.0);
        level = level_within(texel / max(texel_side.x, texel_side.y));
    }
    // A texel of the pixel's own footprint is as fine as the screen can show.
    needed_texel = max(texel_for(radius), footprint);
    return 1 - blocked;
}
