// The square of side 2.

vec4 column_mass(vec2 sides) {
    vec2 cut = clamp(sides, -1, 1);
    return vec4((cut.y - cut.x) / 2, 0, 0, 0);
}

float mass_below(vec4 column, float height) { return column.x * (clamp(height, -1, 1) + 1) / 2; }
