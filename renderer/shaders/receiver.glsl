#version 450 core
// The receiver: the surface point whose visibility is asked for. Every technique gets one and defines
//
//     float visibility(Receiver receiver);      1 lit, 0 in shadow
//
// Texel space is light_frustum.h's: x and y in texels of the shadow map, depth in [0, 1].

struct Receiver {
    vec2 texel;
    float depth;
    // Change of the depth of the surface's plane along x and y, per texel.
    vec2 slope;
    // How far two computations of the same point's depth may differ.
    float tolerance;
};

layout(binding = 0) uniform sampler2D shadow_map;

uniform mat4 texel_from_world;
// Rows: the light's right, up, and the direction to the light.
uniform mat3 light_from_world;
// World units of depth along the light per texel on x and y, over the depth range: what slope 1 (45°) amounts to.
uniform vec2 depth_per_texel;
// Parts of a texel that the rasteriser snaps vertices to, 2^-GL_SUBPIXEL_BITS.
uniform float subpixel;
uniform vec3 eye;

// Three numbers a triangle: its own normal, in the order the index buffer has them.
layout(std430, binding = 1) readonly buffer FacetNormals { float facet_normals[]; };
// The first triangle of this draw.
uniform int first_triangle;

// The normal of the triangle at hand, facing the viewer. Interpolated normals would tilt the receiver's plane out of
// the surface; so would, slightly, derivatives of the interpolated position, which are off by some 1e-4: enough for
// acne over a filter of 70 texels.
vec3 facet_normal(vec3 world) {
    int at = 3 * (first_triangle + gl_PrimitiveID);
    vec3 normal = vec3(facet_normals[at], facet_normals[at + 1], facet_normals[at + 2]);
    return dot(normal, eye - world) < 0 ? -normal : normal;
}

// The receiver at a surface point whose normal faces the light by `facing` = cos of the angle between, > 0.
Receiver receiver_at(vec3 world, vec3 normal) {
    vec3 texel = (texel_from_world * vec4(world, 1)).xyz;
    vec3 light_normal = light_from_world * normal;
    // Steeper than 87° (1 : 20) half a subpixel moves the plane by more than a texel's side, and no light arrives.
    vec2 slope = light_normal.xy / max(light_normal.z, 0.05) * depth_per_texel;

    // The depth stored for a texel is that of the caster's plane, up to where the rasteriser moved its vertices (half
    // a subpixel), and float rounding: some units in the last place of the position in texels, and of the depth.
    float steepness = abs(slope.x) + abs(slope.y);
    float rounding = 16 * 1.2e-7 * float(textureSize(shadow_map, 0).x);
    return Receiver(texel.xy, texel.z, slope, steepness * (subpixel + rounding) + 16 * 1.2e-7);
}

// Depth of the receiver's plane at four points of the map, less what rounding may have added: what the depths stored
// there compare with.
vec4 plane_depth(Receiver receiver, vec4 x, vec4 y) {
    return receiver.depth - receiver.tolerance + receiver.slope.x * (x - receiver.texel.x) +
           receiver.slope.y * (y - receiver.texel.y);
}

// Which depths read from the map leave these lit. Depths beyond the map's far end count as its end, where empty texels
// are: behind any caster, and lit where there is none.
vec4 lit(vec4 depth, vec4 stored) { return step(min(depth, 1), stored); }

// Whether the light reaches the receiver past what the map holds at the texel around a point.
float lit_at(Receiver receiver, vec2 point) {
    vec2 centre = floor(point) + 0.5;
    float stored = textureLod(shadow_map, centre / vec2(textureSize(shadow_map, 0)), 0).r;
    return lit(plane_depth(receiver, vec4(centre.x), vec4(centre.y)), vec4(stored)).x;
}
