#version 450 core
// A level of a shadow map, drawn beside it: of every factor × factor texels the one in the middle (map_levels.h). What lies
// beyond the map is empty.

layout(binding = 0) uniform sampler2D shadow_map;

uniform vec2 map_size;
uniform vec2 place;
uniform int factor;

const int kGuard = 2;

void main() {
    ivec2 texel = (ivec2(gl_FragCoord.xy) - ivec2(place)) * factor + factor / 2;
    bool inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(vec2(texel), map_size));
    gl_FragDepth = inside ? texelFetch(shadow_map, texel + kGuard, 0).r : 1;
}
