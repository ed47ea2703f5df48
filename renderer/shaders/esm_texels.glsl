// What an exponential shadow map keeps of a texel: whether it holds a caster, and exp(−k h) of its height h.

uniform float exponent;

vec4 kept(ivec2 texel) {
    float height = height_at(texel);
    return height <= 0 ? vec4(0) : vec4(1, exp(-exponent * height), 0, 0);
}
