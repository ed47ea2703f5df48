// The surface at a pixel, as surface.frag has stored it. surface.glsl goes before.

layout(binding = 4) uniform sampler2D planes;
layout(binding = 5) uniform usampler2D materials;

// The ray through pixel (0, 0)'s lower left corner, eye space, one unit deep along the view, and how it changes per pixel.
uniform vec3 ray_corner;
uniform vec3 ray_right;
uniform vec3 ray_up;

Surface surface_at(ivec2 pixel) {
    vec4 plane = texelFetch(planes, pixel, 0);
    vec2 centre = vec2(pixel) + 0.5;
    vec3 ray = ray_corner + centre.x * ray_right + centre.y * ray_up;
    uvec2 material = texelFetch(materials, pixel, 0).rg;
    // A plane seen from its very edge is met far away, not nowhere.
    float along = plane.xyz == vec3(0) ? 1 : plane.w / min(dot(plane.xyz, ray), -1e-7);
    return Surface(along * ray, plane.xyz, unpacked_normal(material), unpacked_base_colour(material),
                   (material.y >> 30) != 0u);
}

Surface surface_here() { return surface_at(ivec2(gl_FragCoord.xy)); }
