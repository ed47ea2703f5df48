// Percentage-closer filtering without error: every texel that the kernel touches counts by the kernel's mass on it. Part
// of a kernel are, with lengths in units of the radius from its centre,
//
//     vec4 column_mass(vec2 sides);                what it has to know of a column from sides.x to sides.y
//     float mass_below(vec4 column, float height); the kernel's mass in that column, up to a height

// Half the side of the square that holds the kernel, texels.
uniform float reach;

float filtered(ivec2 texel, vec2 within) {
    ivec2 first = ivec2(floor(within - reach));
    ivec2 last = ivec2(floor(within + reach));
    float visibility = 0;
    for (int i = first.x; i <= last.x; ++i) {
        vec4 column = column_mass((vec2(i, i + 1) - within.x) / radius);
        float counted = 0;
        for (int j = first.y; j <= last.y; ++j) {
            float mass = mass_below(column, (j + 1 - within.y) / radius);
            visibility += (mass - counted) * lit(texel + ivec2(i, j));
            counted = mass;
        }
    }
    return clamp(visibility, 0, 1);
}
