// The lit surface: a sun or a spot whose shadow the technique decides, and a sky that reaches everywhere.

uniform vec3 background;
// Where a fading mesh begins to and has become the background, as distances from the scene's middle (eye space).
uniform vec3 middle_from_eye;
uniform vec2 fade_range;

layout(location = 0) out vec4 colour;
layout(location = 1) out float shown_need;

const vec3 kSun = vec3(1.12, 1.06, 0.98);
const vec3 kSky = vec3(0.34, 0.38, 0.45);
const vec3 kBounce = vec3(0.20, 0.185, 0.17);

void main() {
    Surface surface = surface_here();
    vec3 towards = to_light(surface.from_eye);
    float light = light_at(surface.from_eye, surface.facet, towards);
    vec3 sun = kSun * max(dot(surface.normal, towards), 0) * in_cone(towards) * light;
    vec3 radiance = surface.base_colour * (sun + mix(kBounce, kSky, 0.5 + 0.5 * surface.normal.y));
    if (surface.fades) {
        radiance = mix(radiance, background,
                       smoothstep(fade_range.x, fade_range.y, distance(surface.from_eye, middle_from_eye)));
    }
    colour = vec4(surface.facet == vec3(0) ? background : radiance, 1);
    shown_need = needed_texel;
}
