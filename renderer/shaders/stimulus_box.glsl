// The square of side 2.
float mass_below(vec2 column, float height) {
    vec2 side = clamp(column, -1, 1);
    return (side.y - side.x) * (clamp(height, -1, 1) + 1) / 4;
}
