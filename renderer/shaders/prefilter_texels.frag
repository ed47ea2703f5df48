#version 450 core
// The first step of a prefiltered map: of every factor.x × factor.y texels of the shadow map, the mean of what a technique
// keeps of one. After it goes
//
//     vec4 kept(ivec2 texel);
//
// which is 0 for an empty texel, as it is for what lies beyond the map.

layout(binding = 0) uniform sampler2D shadow_map;

uniform vec2 map_size;
uniform vec2 factor;

out vec4 mean;

const int kGuard = 2;

// Height of what a texel holds above the map's far end, in [0, 1]; 0 where it is empty. Beyond the map all is.
float height_at(ivec2 texel) {
    return 1 - texelFetch(shadow_map, clamp(texel, ivec2(-1), ivec2(map_size)) + kGuard, 0).r;
}

vec4 kept(ivec2 texel);

void main() {
    ivec2 block = ivec2(factor);
    ivec2 first = ivec2(gl_FragCoord.xy) * block;
    ivec2 end = min(first + block, ivec2(map_size));
    vec4 sum = vec4(0);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) sum += kept(ivec2(x, y));
    }
    mean = sum / float(block.x * block.y);
}
