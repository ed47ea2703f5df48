#version 450 core
// A further step of a prefiltered map: of every factor.x × factor.y texels the mean. What lies beyond them is empty.

layout(binding = 0) uniform sampler2D texels;

uniform vec2 size;
uniform vec2 factor;

out vec4 mean;

void main() {
    ivec2 block = ivec2(factor);
    ivec2 first = ivec2(gl_FragCoord.xy) * block;
    ivec2 end = min(first + block, ivec2(size));
    vec4 sum = vec4(0);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) sum += texelFetch(texels, ivec2(x, y), 0);
    }
    mean = sum / float(block.x * block.y);
}
