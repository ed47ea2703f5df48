// Visibility at the pixel's centre, as a number.

// Distance from the occluder's edge, texels: x·p.x + y·p.y + z.
uniform vec3 edge;
// From here on, on either side of the edge, all texels under the kernel are alike.
uniform float alike_beyond;

// Per column and row of the image: the texel that its centre lies in, and where in it.
layout(std430, binding = 0) readonly buffer Columns { vec2 columns[]; };
layout(std430, binding = 1) readonly buffer Rows { vec2 rows[]; };

out float shown_visibility;

void main() {
    vec2 column = columns[int(gl_FragCoord.x)];
    vec2 row = rows[int(gl_FragCoord.y)];
    ivec2 texel = ivec2(column.x, row.x);
    vec2 within = vec2(column.y, row.y);
    float distance = dot(edge.xy, vec2(texel) + within) + edge.z;
    shown_visibility = radius > 0 && abs(distance) < alike_beyond ? filtered(texel, within) : lit(texel);
}
