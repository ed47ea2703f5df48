#version 450 core
// The same of each window of 3 × 3 blocks. The first window starts three blocks before the first.

layout(binding = 0) uniform sampler2D block_ranges;

uniform vec2 blocks;

out vec4 range;

// Between texels' centres and their block's.
const float kHalfBlock = 1.5;

void main() {
    ivec2 count = ivec2(blocks);
    ivec2 first = ivec2(gl_FragCoord.xy) - 3;
    vec4 block[9];
    float high = 0;
    for (int k = 0; k < 9; ++k) {
        ivec2 at = first + ivec2(k % 3, k / 3);
        bool inside = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, count));
        block[k] = inside ? texelFetch(block_ranges, at, 0) : vec4(0, 0, 1e30, 1);
        high = max(high, block[k].w);
    }
    // Of planes with the slope of one of the blocks, the one that lies farthest back.
    range = vec4(0, 0, -1e30, high);
    for (int k = 0; k < 9; ++k) {
        vec2 slope = block[k].xy;
        float low = 1e30;
        for (int l = 0; l < 9; ++l) {
            vec2 from_centre = 4 * vec2(l % 3 - 1, l / 3 - 1);
            vec2 tilt = abs(block[l].xy - slope);
            low = min(low, block[l].z - kHalfBlock * (tilt.x + tilt.y) - dot(slope, from_centre));
        }
        if (low > range.z) range.xyz = vec3(slope, low);
    }
}
