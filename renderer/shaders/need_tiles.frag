#version 450 core
// Of each tile of 8 × 8 pixels the finest texel that one of them needs, and what one of them, which differs from tile to
// tile, needs.

layout(binding = 0) uniform sampler2D need;

out vec2 tile;

const int kSide = 8;

void main() {
    ivec2 last = textureSize(need, 0) - 1;
    ivec2 at = ivec2(gl_FragCoord.xy);
    float finest = 1e30;
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            finest = min(finest, texelFetch(need, min(kSide * at + ivec2(i, j), last), 0).r);
        }
    }
    ivec2 one = ivec2(5 * at.x + 3 * at.y, 3 * at.x + 7 * at.y) % kSide;
    tile = vec2(finest, texelFetch(need, min(kSide * at + one, last), 0).r);
}
