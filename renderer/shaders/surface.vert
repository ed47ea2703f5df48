#version 450 core
// Surfaces as the camera sees them.
//
// Eye space has the world's axes around the camera's eye: small numbers keep their precision, wherever the world's origin is.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
// Of the triangle that this vertex ends, unit length.
layout(location = 3) in vec3 facet_normal;

uniform mat4 eye_from_model;
uniform mat4 clip_from_eye;

out vec3 vertex_from_eye;
out vec3 vertex_normal;
out vec2 texture_uv;
// The triangle's own plane, n·x = d: n faces the viewer, so d ≤ 0.
flat out vec4 vertex_plane;

// The same in all programs, to the last bit: passes meet each other's depths, and pictures have the same edges.
invariant gl_Position;

void main() {
    vertex_from_eye = (eye_from_model * vec4(position, 1)).xyz;
    vertex_normal = mat3(eye_from_model) * normal;
    texture_uv = uv;
    vec3 facet = mat3(eye_from_model) * facet_normal;
    float distance = dot(facet, vertex_from_eye);
    vertex_plane = distance > 0 ? -vec4(facet, distance) : vec4(facet, distance);
    gl_Position = clip_from_eye * vec4(vertex_from_eye, 1);
}
