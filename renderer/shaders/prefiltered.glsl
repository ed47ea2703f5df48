// The look into a prefiltered map (prefiltered_map.h).

layout(binding = 2) uniform sampler2D prefiltered;
// Texels of the shadow map a texel of it; its texels before those of the map; 1 / size of its texture.
uniform vec2 prefiltered_factor;
uniform vec2 prefiltered_border;
uniform vec2 prefiltered_scale;
// Half-width of its filter, texels of the shadow map.
uniform vec2 prefiltered_radius;

struct Prefiltered {
    // The filter's share that holds casters, and means of what a technique keeps of them, over the filter and the pixel.
    float casters;
    vec3 mean;
    // What casters must be above to be in the receiver's way: its height above the map's far end, and what the mean of its own
    // surface may be above that.
    float height;
    // How far a depth may differ by rounding: a receiver's tolerance, over texels as large as these.
    float tolerance;
};

// A share of the filter that is rounding's.
const float kNothing = 1e-6;

Prefiltered prefiltered_around(Receiver receiver) {
    vec2 side = prefiltered_factor * texel_side;
    // Side of a square of the pixel's area; along a longer footprint what the filter blurs is looked at too seldom, but not
    // blurred further. Finite, also where a light's own plane lies within the pixel.
    float pixel = clamp(sqrt(covered / (side.x * side.y)), 1, 65536);
    vec2 place = (receiver.texel / prefiltered_factor + prefiltered_border) * prefiltered_scale;
    // Beyond the texture all is empty, whose coarsest level blends into it over its own width.
    vec4 mean = textureLod(prefiltered, clamp(place, vec2(-2), vec2(3)), log2(pixel));
    vec2 texel = prefiltered_factor * pixel;
    float tolerance = (receiver.tolerance - depth_step) * max(texel.x, texel.y) + depth_step;
    // A surface that fills the filter has its mean at the receiver's own height. Of one that ends within, a share is there,
    // the upper at worst: its mean is above by the rest's share of how far the plane rises to the filter's rim.
    float rise = dot(abs(receiver.slope), prefiltered_radius + texel);
    float height = 1 - receiver.depth + tolerance + max(1 - mean.x, 0) * rise;
    // Below 0 beyond the map's far end: how far below a caster a receiver lies counts.
    return Prefiltered(mean.x, mean.yzw / max(mean.x, kNothing), height, tolerance);
}
