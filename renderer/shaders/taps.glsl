// Taps of a filter, in units of its radius. What a fixed set of taps misses looks like bands; sets that each pixel moves
// by a random amount of its own turn that into noise without bias.

struct TapSet {
    int count;
    // Each pixel shifts its taps by a random part of a cell of this side, in units of the radius.
    float cell;
    // Whether each pixel turns its taps by a random angle.
    int turned;
};
uniform TapSet tap_sets[2];
layout(std430, binding = 2) readonly buffer Taps0 { vec2 taps0[]; };
layout(std430, binding = 3) readonly buffer Taps1 { vec2 taps1[]; };

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

// How this pixel moves the taps of a set: p becomes xy + mat2(z, w, −w, z)·p.
vec4 tap_motion(int set) {
    vec2 noise = pixel_noise(uvec2(gl_FragCoord.xy) + uint(set) * 4096u);
    float angle = tap_sets[set].turned != 0 ? 6.28318531 * noise.x : 0;
    return vec4((noise - 0.5) * tap_sets[set].cell, cos(angle), sin(angle));
}

vec2 moved(vec2 tap, vec4 motion) {
    return motion.xy + vec2(motion.z * tap.x - motion.w * tap.y, motion.w * tap.x + motion.z * tap.y);
}

// Share of the taps that leave the receiver lit, within a radius in texels.
float lit_share(Receiver receiver, vec2 radius) {
    vec4 motion = tap_motion(0);
    float sum = 0;
    for (int i = 0; i < tap_sets[0].count; ++i) {
        sum += lit_at(receiver, receiver.texel + moved(taps0[i], motion) * radius);
    }
    return sum / float(tap_sets[0].count);
}
