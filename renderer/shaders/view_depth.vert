#version 450 core
// What the camera sees nearest: the depths that the lighting pass then meets again.

layout(location = 0) in vec3 position;

uniform mat4 eye_from_model;
uniform mat4 clip_from_eye;

invariant gl_Position;

void main() {
    vec3 from_eye = (eye_from_model * vec4(position, 1)).xyz;
    gl_Position = clip_from_eye * vec4(from_eye, 1);
}
