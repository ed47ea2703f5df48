#version 450 core
// The lighting pass: everything as the camera sees it.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;

uniform mat4 world_from_model;
uniform mat4 clip_from_world;

out vec3 world;
out vec3 world_normal;
out vec2 texture_uv;

void main() {
    world = (world_from_model * vec4(position, 1)).xyz;
    world_normal = mat3(world_from_model) * normal;
    texture_uv = uv;
    gl_Position = clip_from_world * vec4(world, 1);
}
