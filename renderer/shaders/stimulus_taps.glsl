// Percentage-closer filtering by taps (Reeves et al. 1987): the share that finds its texel lit.

uniform int tap_count;
// Whether each pixel turns the taps by an angle of its own; else the first turn is everyone's.
uniform int rotated;
uniform int image_width;

// x and y in units of the radius.
layout(std430, binding = 2) readonly buffer Taps { vec2 taps[]; };
// Cosine and sine, row by row from the bottom. As data: the hash that gives the angle needs 64-bit integers.
layout(std430, binding = 3) readonly buffer Turns { vec2 turns[]; };

float filtered(ivec2 texel, vec2 within) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 turn = turns[rotated * (pixel.y * image_width + pixel.x)];
    int count = 0;
    for (int i = 0; i < tap_count; ++i) {
        vec2 tap = taps[i];
        vec2 turned = vec2(turn.x * tap.x - turn.y * tap.y, turn.y * tap.x + turn.x * tap.y);
        count += int(lit(texel + ivec2(floor(within + radius * turned))));
    }
    return float(count) / float(tap_count);
}
