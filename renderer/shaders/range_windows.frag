#version 450 core
// Nearest and farthest depth of each window of 3 × 3 blocks. The first window starts three blocks before the first.

layout(binding = 0) uniform sampler2D block_ranges;

uniform vec2 blocks;

out vec2 range;

void main() {
    ivec2 count = ivec2(blocks);
    ivec2 first = ivec2(gl_FragCoord.xy) - 3;
    range = vec2(1, 0);
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            ivec2 at = first + ivec2(i, j);
            bool inside = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, count));
            vec2 block = inside ? texelFetch(block_ranges, at, 0).xy : vec2(1);
            range = vec2(min(range.x, block.x), max(range.y, block.y));
        }
    }
}
