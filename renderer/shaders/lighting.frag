// The lit surface: suns and spots whose shadows the technique decides, and a sky that reaches everywhere. One pass a light; what
// the sky gives comes with the first.

uniform vec3 background;
// Where a fading mesh begins to and has become the background, as distances from the scene's middle (eye space).
uniform vec3 middle_from_eye;
uniform vec2 fade_range;
// Whether this is the first light; the others' passes add to it.
uniform int first_light;

layout(location = 0) out vec4 colour;
layout(location = 1) out float shown_need;
layout(location = 2) out float kept_visibility;

const vec3 kSun = vec3(1.12, 1.06, 0.98);
const vec3 kSky = vec3(0.34, 0.38, 0.45);
const vec3 kBounce = vec3(0.20, 0.185, 0.17);

void main() {
    Surface surface = surface_here();
    if (is_others(surface)) discard;
    vec3 towards = to_light(surface.from_eye);
    float light = light_at(surface.from_eye, surface.facet, towards);
    vec3 irradiance = kSun * max(dot(surface.normal, towards), 0) * in_cone(towards) * light;
    if (first_light != 0) irradiance += mix(kBounce, kSky, 0.5 + 0.5 * surface.normal.y);
    float fade = 0;
    if (surface.fades) fade = smoothstep(fade_range.x, fade_range.y, distance(surface.from_eye, middle_from_eye));
    vec3 behind = first_light != 0 ? background : vec3(0);
    colour = vec4(mix(surface.base_colour * irradiance, behind, fade), 1);
    shown_need = needed_texel;
    kept_visibility = light;
}
