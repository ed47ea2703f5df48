#version 450 core
// A stimulus as a shadow map leaves it: the receiver is a plane parallel to screen and map alike, so its depth is one
// number, nothing needs a bias, and a pixel's place in the map is known to the last bit. A kernel defines
//
//     float filtered(ivec2 texel, vec2 within);      1 lit, 0 in shadow
//
// for a pixel centre that lies `within` [0, 1]² of a texel. Whole texels and parts stay apart: near to each other, the
// borders of texels and the kernel are small numbers, which keep their precision.

layout(binding = 0) uniform sampler2D shadow_map;

// Of the kernel, texels.
uniform float radius;

// The shadow test of Williams 1978, for one texel: whether light reaches the receiver past the nearest caster.
float lit(ivec2 texel) { return step(gl_FragCoord.z, texelFetch(shadow_map, texel, 0).r); }
