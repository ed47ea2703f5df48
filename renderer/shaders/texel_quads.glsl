// The depths stored at the four texels that share a corner, from the upper left clockwise: out of texels that hold just those
// (texel_quads.h). 1, as in all empty texels, beyond the map.

layout(binding = 2) uniform sampler2D texel_quads;

vec4 stored_around(vec2 corner) {
    return texelFetch(texel_quads, ivec2(clamp(corner, vec2(-1), map_size + 1)) + kGuard - 1, 0);
}
