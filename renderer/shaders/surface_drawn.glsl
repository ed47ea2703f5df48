// The surface at this pixel, of the triangle that is being drawn. surface.glsl and `const bool textured` go before.

in vec3 vertex_from_eye;
in vec3 vertex_normal;
in vec2 texture_uv;
flat in vec4 vertex_plane;

layout(binding = 1) uniform sampler2D base_colour_texture;
uniform vec3 base_colour;
uniform int fading;

Surface surface_here() {
    vec3 normal = normalize(vertex_normal);
    if (dot(normal, vertex_plane.xyz) < 0) normal = -normal;
    vec3 base = base_colour;
    if (textured) base *= texture(base_colour_texture, texture_uv).rgb;
    return Surface(vertex_from_eye, vertex_plane.xyz, normal, base, fading != 0);
}
