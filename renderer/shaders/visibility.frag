// Visibility alone, as a number: what techniques are compared by.

in vec3 world;

uniform vec3 to_light;

out float shown_visibility;

void main() {
    vec3 facet = facet_normal(world);
    shown_visibility = dot(facet, to_light) > 0 ? visibility(receiver_at(world, facet)) : 0;
}
