// The look into a prefiltered map (prefiltered_map.h).

layout(binding = 2) uniform sampler2D prefiltered;
// Texels of the shadow map a texel of it; its texels before those of the map; 1 / size of its texture.
uniform vec2 prefiltered_factor;
uniform vec2 prefiltered_border;
uniform vec2 prefiltered_scale;

struct Prefiltered {
    // Means of what a technique keeps, over the filter and the pixel.
    vec4 mean;
    // How far a depth may differ from what rounding leaves of the means: a receiver's tolerance, over texels this large.
    float tolerance;
};

Prefiltered prefiltered_around(Receiver receiver) {
    vec2 across = pixel_right / prefiltered_factor;
    vec2 up = pixel_up / prefiltered_factor;
    // Finite, also where a light's own plane lies within the pixel.
    float pixel = clamp(sqrt(max(dot(across, across), dot(up, up))), 1, 65536);
    vec2 place = (receiver.texel / prefiltered_factor + prefiltered_border) * prefiltered_scale;
    // Beyond the texture all is empty, whose coarsest level blends into it over its own width.
    vec4 mean = textureLod(prefiltered, clamp(place, vec2(-2), vec2(3)), log2(pixel));
    return Prefiltered(mean, receiver.tolerance * pixel * max(prefiltered_factor.x, prefiltered_factor.y));
}

// A share of the filter that is rounding's.
const float kNothing = 1e-6;
