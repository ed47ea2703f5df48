// Bounds of what each tile of pixels has stored: of the surfaces' points (eye space) and of their facets' normals. Low is above
// high where nothing is. surface_stored.glsl goes before.

// Pixels of a tile's side, and from one that is looked at to the next.
uniform int side_px;
uniform int step_px;

layout(location = 0) out vec4 point_low;
layout(location = 1) out vec4 point_high;
layout(location = 2) out vec4 normal_low;
layout(location = 3) out vec4 normal_high;

void main() {
    ivec2 end = textureSize(planes, 0) - 1;
    ivec2 first = side_px * ivec2(gl_FragCoord.xy);
    point_low = normal_low = vec4(1e30);
    point_high = normal_high = vec4(-1e30);
    for (int y = 0; y < side_px; y += step_px) {
        for (int x = 0; x < side_px; x += step_px) {
            Surface surface = surface_at(min(first + ivec2(x, y), end));
            if (surface.facet != vec3(0)) {
                point_low.xyz = min(point_low.xyz, surface.from_eye);
                point_high.xyz = max(point_high.xyz, surface.from_eye);
                normal_low.xyz = min(normal_low.xyz, surface.facet);
                normal_high.xyz = max(normal_high.xyz, surface.facet);
            }
        }
    }
}
