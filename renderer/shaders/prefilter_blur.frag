#version 450 core
// The box filter along one axis: whole texels within it, and at its two ends those that it covers a part of. The result
// begins `reach` texels before the first. What lies beyond the texels is empty.

layout(binding = 0) uniform sampler2D texels;

uniform vec2 size;
// (1, 0) or (0, 1).
uniform vec2 axis;
// Texels on each side of the middle one, and the part of the last that counts.
uniform int reach;
uniform float end_weight;

out vec4 mean;

void main() {
    ivec2 step_texels = ivec2(axis);
    ivec2 middle = ivec2(gl_FragCoord.xy) - reach * step_texels;
    int at = axis.x > 0 ? middle.x : middle.y;
    int count = int(axis.x > 0 ? size.x : size.y);
    vec4 sum = vec4(0);
    for (int i = max(-reach, -at); i <= min(reach, count - 1 - at); ++i) {
        sum += (abs(i) == reach && reach > 0 ? end_weight : 1) * texelFetch(texels, middle + i * step_texels, 0);
    }
    mean = sum / (reach > 0 ? float(2 * reach - 1) + 2 * end_weight : 1);
}
