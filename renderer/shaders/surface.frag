// The nearest surface of each pixel, stored: lit later, and once. surface_drawn.glsl goes before.

layout(location = 0) out vec4 plane;
layout(location = 1) out uvec2 material;

void main() {
    Surface surface = surface_here();
    plane = vertex_plane;
    material = packed_material(surface.normal, surface.base_colour, surface.fades);
}
