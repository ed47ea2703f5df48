// The unit disk.

const float pi = 3.14159265;

// ∫ √(1 − t²) dt from 0 to x. The arc sine by way of the arc tangent, which drivers compute more precisely.
vec2 quarter_area(vec2 x) {
    vec2 height = sqrt((1 - x) * (1 + x));
    return (x * height + atan(x, height)) / 2;
}

// Both sides, and what the column has of the disk.
vec4 column_mass(vec2 sides) {
    vec2 cut = clamp(sides, -1, 1);
    vec2 area = 2 * quarter_area(cut);
    return vec4(cut, area.y - area.x, 0);
}

float mass_below(vec4 column, float height) {
    // The part beyond the level |h|: from a cap of half-width w.
    float h = clamp(height, -1, 1);
    float w = sqrt((1 - h) * (1 + h));
    vec2 cut = clamp(column.xy, -w, w);
    vec2 area = quarter_area(cut) - abs(h) * cut;
    float beyond = area.y - area.x;
    return (h < 0 ? beyond : column.z - beyond) / pi;
}
