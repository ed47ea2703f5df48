// Visibility alone, as a number: what techniques are compared by.

in vec3 world;

layout(location = 0) out float shown_visibility;
layout(location = 1) out float shown_need;

void main() {
    shown_visibility = light_at(world, facet_normal(world), to_light(world));
    shown_need = needed_texel;
}
