#version 450 core
// The depth pass: casters as the light sees them.

layout(location = 0) in vec3 position;

uniform mat4 texel_from_world;
uniform vec2 map_size;

void main() {
    vec3 texel = (texel_from_world * vec4(position, 1)).xyz;
    gl_Position = vec4(texel.xy / map_size * 2 - 1, texel.z, 1);
}
