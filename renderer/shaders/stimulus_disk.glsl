// The unit disk.

const float pi = 3.14159265;

// ∫ √(1 − t²) dt from 0 to x. The arc sine by way of the arc tangent, which drivers compute more precisely.
vec2 quarter_area(vec2 x) {
    vec2 height = sqrt((1 - x) * (1 + x));
    return (x * height + atan(x, height)) / 2;
}

float mass_below(vec2 column, float height) {
    vec2 side = clamp(column, -1, 1);
    float h = clamp(height, -1, 1);
    // The part beyond the level |h|, a cap of half-width w, and what the column has of the disk.
    float w = sqrt((1 - h) * (1 + h));
    vec2 cut = clamp(side, -w, w);
    vec2 cap_area = quarter_area(cut) - abs(h) * cut;
    vec2 whole_area = 2 * quarter_area(side);
    float cap = cap_area.y - cap_area.x;
    return (h < 0 ? cap : whole_area.y - whole_area.x - cap) / pi;
}
