// The receiver: the surface point whose visibility is asked for. Every technique gets one and defines
//
//     float visibility(Receiver receiver);      1 lit, 0 in shadow
//
// Ahead of it go the version and `const bool spot`: whether the light is a spot, known when the shader is compiled.
// Texel space is shadow_map_shape.h's: x and y in texels of the shadow map, depth in [0, 1].

struct Receiver {
    vec2 texel;
    float depth;
    // Change of the depth of the surface's plane along x and y, per texel.
    vec2 slope;
    // How far two computations of the same point's depth may differ.
    float tolerance;
};

float visibility(Receiver receiver);

// The texel, in the light plane, that this pixel needs: written beside its colour by techniques that size their map by
// what pixels need. As it is, none.
float needed_texel = 1e30;
// Side of the texel, in the light plane, of which two would cover this pixel's surface if that faced the light: the finest
// that is of use. On a surface that doesn't, texels are stretched by as much as its light is weaker.
float footprint = 0;
// Change of the receiver's place, texels, from this pixel to the next one to the right and upwards, on its surface.
vec2 pixel_right = vec2(0);
vec2 pixel_up = vec2(0);

// The map lies in its texture with guard texels around it, which are empty.
layout(binding = 0) uniform sampler2D shadow_map;
uniform vec2 map_size;
uniform vec2 map_scale;  // 1 / size of the texture
const int kGuard = 2;

// For world space shifted to the light's own origin: small numbers keep their precision.
uniform vec3 light_origin;
uniform mat4 texel_from_light;
// What planes transform by: the inverse's transpose.
uniform mat4 texel_plane_from_light;
// Directional: to the light. Spot: against its axis.
uniform vec3 light_back;
// Cosines of the angles where a spot's light begins to fade and where it ends.
uniform vec2 cone;
// Parts of a texel that the rasteriser snaps vertices to, 2^-GL_SUBPIXEL_BITS.
uniform float subpixel;
uniform vec3 eye;

// Three numbers a triangle: its own normal, in the order the index buffer has them.
layout(std430, binding = 1) readonly buffer FacetNormals { float facet_normals[]; };
// The first triangle of this draw.
uniform int first_triangle;
uniform mat4 world_from_model;

// The normal of the triangle at hand, facing the viewer. Interpolated normals would tilt the receiver's plane out of
// the surface; so would, slightly, derivatives of the interpolated position, which are off by some 1e-4: enough for
// acne over a filter of 70 texels.
vec3 facet_normal(vec3 world) {
    int at = 3 * (first_triangle + gl_PrimitiveID);
    vec3 normal = mat3(world_from_model) * vec3(facet_normals[at], facet_normals[at + 1], facet_normals[at + 2]);
    return dot(normal, eye - world) < 0 ? -normal : normal;
}

vec3 to_light(vec3 world) { return spot ? normalize(light_origin - world) : light_back; }

// Share of a spot's light that goes this way.
float in_cone(vec3 to_light) { return spot ? smoothstep(cone.y, cone.x, dot(to_light, light_back)) : 1; }

// The receiver at a surface point with this normal, which faces the light.
Receiver receiver_at(vec3 world, vec3 normal, vec3 to_light) {
    vec3 from_light = world - light_origin;
    vec4 point = texel_from_light * vec4(from_light, 1);
    vec3 texel = point.xyz / point.w;
    // Steeper than 87° (1 : 20) half a subpixel moves the plane by more than a texel's side, and no light arrives.
    normal += max(0.05 - dot(normal, to_light), 0) * to_light;
    vec4 plane = texel_plane_from_light * vec4(normal, -dot(normal, from_light));
    vec2 slope = -plane.xy / plane.z;

    // The depth stored for a texel is that of the caster's plane, up to where the rasteriser moved its vertices (half
    // a subpixel), and float rounding: some units in the last place of the position in texels, and of the depth.
    float steepness = abs(slope.x) + abs(slope.y);
    float rounding = 16 * 1.2e-7 * map_size.x;
    return Receiver(texel.xy, texel.z, slope, steepness * (subpixel + rounding) + 16 * 1.2e-7);
}

// Side of a texel in the light plane.
uniform vec2 texel_side;

// Visibility of the light at a surface point; 0 where its facet is turned away (it is in its own shadow, no map is needed
// to know) and outside a spot's cone.
float light_at(vec3 world, vec3 facet, vec3 to_light) {
    Receiver receiver = receiver_at(world, facet, to_light);
    // Here, as derivatives need all of a quad's pixels.
    pixel_right = dFdx(receiver.texel);
    pixel_up = dFdy(receiver.texel);
    vec2 across = pixel_right * texel_side;
    vec2 up = pixel_up * texel_side;
    float facing = dot(facet, to_light);
    footprint = sqrt(abs(across.x * up.y - across.y * up.x) / max(facing, 0.05) / 2);
    if (facing <= 0 || in_cone(to_light) <= 0) return 0;
    return visibility(receiver);
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

// The depth stored at a texel; 1, as in all empty texels, beyond the map.
float stored_at(vec2 texel) {
    return texelFetch(shadow_map, ivec2(clamp(texel, vec2(-1), map_size)) + kGuard, 0).r;
}

// The depths stored at the four texels that share this corner: from the upper left clockwise, as textureGather has them.
vec4 stored_around(vec2 corner) {
    return textureGather(shadow_map, (clamp(corner, vec2(-1), map_size + 1) + kGuard) * map_scale);
}

// Whether the light reaches the receiver past what the map holds at the texel around a point.
float lit_at(Receiver receiver, vec2 point) {
    vec2 texel = floor(point);
    vec2 centre = texel + 0.5;
    return lit(plane_depth(receiver, vec4(centre.x), vec4(centre.y)), vec4(stored_at(texel))).x;
}
