// The lit surface: a sun or a spot whose shadow the technique decides, and a sky that reaches everywhere.

in vec3 shading_normal;
in vec2 texture_uv;

layout(binding = 1) uniform sampler2D base_colour_texture;

uniform vec3 base_colour;
uniform int textured;
uniform vec3 background;
// Where a fading mesh begins to and has become the background, as distances from the scene's middle (eye space); far < 0: never.
uniform vec3 middle_from_eye;
uniform float fade_near;
uniform float fade_far;

layout(location = 0) out vec4 colour;
layout(location = 1) out float shown_need;

const vec3 kSun = vec3(1.12, 1.06, 0.98);
const vec3 kSky = vec3(0.34, 0.38, 0.45);
const vec3 kBounce = vec3(0.20, 0.185, 0.17);

void main() {
    vec3 normal = normalize(shading_normal);
    if (dot(normal, facet) < 0) normal = -normal;

    vec3 towards = to_light();
    vec3 sun = kSun * max(dot(normal, towards), 0) * in_cone(towards) * light_here(towards);
    vec3 base = base_colour;
    if (textured != 0) base *= texture(base_colour_texture, texture_uv).rgb;
    vec3 radiance = base * (sun + mix(kBounce, kSky, 0.5 + 0.5 * normal.y));
    if (fade_far > 0) radiance = mix(radiance, background, smoothstep(fade_near, fade_far, distance(from_eye, middle_from_eye)));
    colour = vec4(radiance, 1);
    shown_need = needed_texel;
}
