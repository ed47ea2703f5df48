#version 450 core
// The depths of every four texels that share a corner, side by side in one texel (texel_quads.h).

layout(binding = 0) uniform sampler2D depths;

out vec4 quad;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    quad = vec4(texelFetch(depths, at + ivec2(0, 1), 0).r, texelFetch(depths, at + ivec2(1, 1), 0).r,
                texelFetch(depths, at + ivec2(1, 0), 0).r, texelFetch(depths, at, 0).r);
}
