// Visibility alone, as a number: what techniques are compared by. 1 where nothing is; of several lights their mean.

uniform float share;

layout(location = 0) out float shown_visibility;
layout(location = 1) out float shown_need;
layout(location = 2) out float kept_visibility;

void main() {
    Surface surface = surface_here();
    if (is_others(surface)) discard;
    float light = light_at(surface.from_eye, surface.facet, to_light(surface.from_eye));
    shown_visibility = share * light;
    shown_need = needed_texel;
    kept_visibility = light;
}
