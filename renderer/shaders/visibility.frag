// Visibility alone, as a number: what techniques are compared by.

layout(location = 0) out float shown_visibility;
layout(location = 1) out float shown_need;

void main() {
    shown_visibility = light_here(to_light());
    shown_need = needed_texel;
}
