// Visibility alone, as a number: what techniques are compared by. 1 where nothing is.

layout(location = 0) out float shown_visibility;
layout(location = 1) out float shown_need;

void main() {
    Surface surface = surface_here();
    float light = light_at(surface.from_eye, surface.facet, to_light(surface.from_eye));
    shown_visibility = surface.facet == vec3(0) ? 1 : light;
    shown_need = needed_texel;
}
