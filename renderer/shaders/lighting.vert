// The lighting pass: everything as the camera sees it. Ahead of it go the version and `const bool spot`.
//
// Eye space has the world's axes around the camera's eye: small numbers keep their precision, wherever the world's origin is.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
// Of the triangle that this vertex ends, unit length.
layout(location = 3) in vec3 facet_normal;

uniform mat4 eye_from_model;
uniform mat4 clip_from_eye;
uniform mat4 texel_from_eye;
// What planes transform by: the inverse's transpose.
uniform mat4 texel_plane_from_eye;
uniform vec3 light_back;

out vec3 from_eye;
out vec3 shading_normal;
out vec2 texture_uv;
// Texel space, homogeneous.
out vec4 map_place;
// The triangle's own normal, facing the viewer.
flat out vec3 facet;
// Of a directional light: change of the depth of the triangle's plane, per texel.
flat out vec2 facet_slope;
// A pass before this one has left the same depths.
invariant gl_Position;

void main() {
    from_eye = (eye_from_model * vec4(position, 1)).xyz;
    shading_normal = mat3(eye_from_model) * normal;
    texture_uv = uv;
    map_place = texel_from_eye * vec4(from_eye, 1);
    facet = mat3(eye_from_model) * facet_normal;
    if (dot(facet, from_eye) > 0) facet = -facet;
    if (!spot) {
        vec3 plane = mat3(texel_plane_from_eye) * no_steeper(facet, light_back);
        facet_slope = -plane.xy / plane.z;
    } else {
        facet_slope = vec2(0);
    }
    gl_Position = clip_from_eye * vec4(from_eye, 1);
}
