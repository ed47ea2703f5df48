// What lies in windows of a shadow map: a plane that no caster lies before, and the farthest depth (depth_ranges.h).

layout(binding = 3) uniform sampler2D window_ranges;
uniform vec2 last_window;

// Whether all texels of `count` from `first` on, at most 8 each way, leave the receiver lit (1), or dark (−1), or may do both
// (0). `origin` is where the texture has texel (0, 0).
int all_alike(Receiver receiver, vec2 first, vec2 count, vec2 origin) {
    // The window that holds the 9 × 9 texels from the first on, and some more.
    vec2 block = floor((origin + first) / 4);
    vec4 window = texelFetch(window_ranges, ivec2(clamp(block + 3, vec2(0), last_window)), 0);
    vec2 middle = first + 0.5 * count;
    vec2 from_centre = origin + middle - (4 * block + 6);
    // Between texels' centres and the middle.
    vec2 half_width = 0.5 * count - 0.5;

    float depth = receiver.depth - receiver.tolerance + dot(receiver.slope, middle - receiver.texel);
    float tilt = dot(abs(receiver.slope - window.xy), half_width);
    if (depth + tilt <= window.z + dot(window.xy, from_centre)) return 1;
    return min(depth - dot(abs(receiver.slope), half_width), 1) > window.w ? -1 : 0;
}
