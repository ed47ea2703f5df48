#version 450 core
// Of each block of 4 × 4 texels a plane that its casters don't lie before, and the farthest depth (depth_ranges.h).

layout(binding = 0) uniform sampler2D depths;

uniform vec2 size;

// The plane's change along x and y, per texel, and its depth at the block's centre; the farthest depth.
out vec4 range;

const float kNone = 1e30;

// A step between two texels; none where one of them is empty.
vec4 steps(vec4 from, vec4 to) {
    return mix(to - from, vec4(kNone), greaterThanEqual(max(from, to), vec4(1)));
}

float smallest(vec4 a, vec4 b, vec4 c) {
    vec4 least = min(min(abs(a), abs(b)), abs(c));
    return min(min(least.x, least.y), min(least.z, least.w));
}

// The mean of the steps that are, to rounding, as the smallest in size. Steps over an edge are larger than those along the
// surfaces beside it.
float step_along(vec4 a, vec4 b, vec4 c) {
    float least = smallest(a, b, c);
    if (least >= kNone) return 0;
    float most = 1.01 * least + 1e-6;
    vec4 as_small_a = step(abs(a), vec4(most));
    vec4 as_small_b = step(abs(b), vec4(most));
    vec4 as_small_c = step(abs(c), vec4(most));
    float sum = dot(as_small_a, a) + dot(as_small_b, b) + dot(as_small_c, c);
    return sum / dot(as_small_a + as_small_b + as_small_c, vec4(1));
}

void main() {
    ivec2 last = ivec2(size) - 1;
    ivec2 first = 4 * ivec2(gl_FragCoord.xy);
    // rows[j][i]
    mat4 rows;
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) rows[j][i] = texelFetch(depths, min(first + ivec2(i, j), last), 0).r;
    }
    mat4 columns = transpose(rows);
    vec2 slope = vec2(step_along(steps(columns[0], columns[1]), steps(columns[1], columns[2]), steps(columns[2], columns[3])),
                      step_along(steps(rows[0], rows[1]), steps(rows[1], rows[2]), steps(rows[2], rows[3])));

    const vec4 offset = vec4(-1.5, -0.5, 0.5, 1.5);
    vec4 low = vec4(kNone);
    vec4 high = vec4(0);
    for (int j = 0; j < 4; ++j) {
        vec4 above = rows[j] - slope.x * offset - slope.y * offset[j];
        low = min(low, mix(above, vec4(kNone), greaterThanEqual(rows[j], vec4(1))));
        high = max(high, rows[j]);
    }
    range = vec4(slope, min(min(low.x, low.y), min(low.z, low.w)), max(max(high.x, high.y), max(high.z, high.w)));
    // What a block has beyond the texture is empty.
    if (any(greaterThan(first + 3, last))) range.w = 1;
}
