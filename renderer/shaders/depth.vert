#version 450 core
// The depth pass: casters as the light sees them.

layout(location = 0) in vec3 position;

uniform mat4 texel_from_model;
uniform vec2 map_size;

void main() {
    vec4 texel = texel_from_model * vec4(position, 1);
    gl_Position = vec4(texel.xy / map_size * 2 - texel.w, texel.zw);
}
