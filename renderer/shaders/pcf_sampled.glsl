// The box filter by sampling: one tap in each cell of a grid over the box. Each pixel moves all its taps by the same
// random part of a cell, so that what the grid misses becomes noise without bias instead of bands.

// Half-width of the box, texels.
uniform vec2 filter_radius;
uniform int tap_count;
// Side of a cell in units of the radius.
uniform float cell;

// x, y in units of the radius, and the weight: stimuli/kernel.h's box_taps.
layout(std430, binding = 0) readonly buffer Taps { vec4 taps[]; };

// Two numbers in [0, 1) from a pixel's position (pcg2d: Jarzynski & Olano 2020, "Hash functions for GPU rendering").
vec2 pixel_noise(uvec2 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    // The upper 24 bits are what a float holds exactly.
    return vec2(v >> 8u) / 16777216.0;
}

float visibility(Receiver receiver) {
    vec2 shift = (pixel_noise(uvec2(gl_FragCoord.xy)) - 0.5) * cell;
    float sum = 0;
    for (int i = 0; i < tap_count; ++i) {
        sum += taps[i].z * lit_at(receiver, receiver.texel + (taps[i].xy + shift) * filter_radius);
    }
    return clamp(sum, 0, 1);
}
