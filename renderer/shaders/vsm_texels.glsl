// What a variance shadow map keeps of a texel: whether it holds a caster, and of its height h the moments h and h². Within
// the texel the caster is a plane, whose slope adds to the second: its square over 12 along each axis. At a silhouette the
// difference to the neighbour beyond isn't the slope; of the two differences the smaller is taken, and none where they
// differ in sign. Texels of a block tell its slope themselves: what one's own would add is less by the square of their number.

float slope_between(float before, float here, float after) {
    float left = here - before;
    float right = after - here;
    return left * right <= 0 ? 0 : min(abs(left), abs(right));
}

vec4 kept(ivec2 texel) {
    float height = height_at(texel);
    if (height <= 0) return vec4(0);
    float square = height * height;
    if (factor.x == 1) {
        float slope = slope_between(height_at(texel - ivec2(1, 0)), height, height_at(texel + ivec2(1, 0)));
        square += slope * slope / 12;
    }
    if (factor.y == 1) {
        float slope = slope_between(height_at(texel - ivec2(0, 1)), height, height_at(texel + ivec2(0, 1)));
        square += slope * slope / 12;
    }
    return vec4(1, height, square, 0);
}
