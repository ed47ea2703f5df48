#version 450 core
// Nearest and farthest depth of each block of 4 × 4 texels.

layout(binding = 0) uniform sampler2D depths;

uniform vec2 size;

out vec2 range;

void main() {
    ivec2 last = ivec2(size) - 1;
    ivec2 first = 4 * ivec2(gl_FragCoord.xy);
    range = vec2(1, 0);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            float depth = texelFetch(depths, min(first + ivec2(i, j), last), 0).r;
            range = vec2(min(range.x, depth), max(range.y, depth));
        }
    }
    // What a block has beyond the texture is empty.
    if (any(greaterThan(first + 3, last))) range.y = 1;
}
