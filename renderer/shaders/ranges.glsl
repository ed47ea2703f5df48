// Nearest and farthest depth of windows (depth_ranges.h).

layout(binding = 3) uniform sampler2D window_ranges;
uniform vec2 last_window;

// Of the window that holds the 9 × 9 texels from this one on, and some more.
vec2 range_from(vec2 texel) {
    vec2 window = floor(texel / 4) + 3;
    return texelFetch(window_ranges, ivec2(clamp(window, vec2(0), last_window)), 0).xy;
}

// Whether all of a receiver's texels within `half_width` of `middle` are lit (1), dark (−1) or may be both (0), given their
// nearest and farthest depth.
int all_alike(Receiver receiver, vec2 middle, vec2 half_width, vec2 range) {
    float depth = receiver.depth - receiver.tolerance + dot(receiver.slope, middle - receiver.texel);
    float spread = dot(abs(receiver.slope), half_width) + receiver.tolerance;
    if (min(depth + spread, 1) <= range.x) return 1;
    return min(depth - spread, 1) > range.y ? -1 : 0;
}
