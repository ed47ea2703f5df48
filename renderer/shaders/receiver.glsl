// The receiver: the surface point whose visibility is asked for. Every technique gets one and defines
//
//     float visibility(Receiver receiver);      1 lit, 0 in shadow
//
// Ahead of it go the version and what is known when the shader is compiled: `const bool spot`, whether the light is a spot,
// `const bool warped`, whether the map is one of light_warp.h, and `const bool linear_depth`, whether it is a spot's that stores
// linear depths (depth_encoding.h). Texel space is shadow_map_shape.h's: x and y in texels of the shadow map, depth in [0, 1]. Where
// depths are linear planes aren't: a receiver's depth is then −far/z, of which planes are, and lit() compares what that is when
// stored. Eye space has the world's axes around the
// camera's eye: small numbers keep their precision, wherever the world's origin is.

struct Receiver {
    vec2 texel;
    float depth;
    // Change of the depth of the surface's plane along x and y, per texel.
    vec2 slope;
    // How far two computations of the same point's depth may differ.
    float tolerance;
    // Texels along x and y of a length in the light plane, of the number that it has where the map's texels are smallest.
    vec2 scale;
};

float visibility(Receiver receiver);

// The texel, in the light plane, that this pixel needs: written beside its colour by techniques that size their map by
// what pixels need. As it is, none.
float needed_texel = 1e30;
// Side of the texel, in the light plane, of which two would cover this pixel's surface if that faced the light: the finest
// that is of use. On a surface that doesn't, texels are stretched by as much as its light is weaker.
float footprint = 0;
// Area in the light plane that this pixel covers.
float covered = 0;

// The map lies in its texture with guard texels around it, which are empty.
layout(binding = 0) uniform sampler2D shadow_map;
uniform vec2 map_size;
uniform vec2 map_scale;  // 1 / size of the texture
const int kGuard = 2;

// Eye space: where a spot is.
uniform vec3 light_from_eye;
uniform mat4 texel_from_eye;
// What planes transform by: the inverse's transpose.
uniform mat4 texel_plane_from_eye;
// Directional: to the light. Spot: against its axis.
uniform vec3 light_back;
// Cosines of the angles where a spot's light begins to fade and where it ends.
uniform vec2 cone;
// How far a caster's plane, or a receiver's place, may be from where it is: in texels (vertices snap to 2^-GL_SUBPIXEL_BITS of
// one, and floats are rounded), and in stored depth (of a spot at depth 1, falling with the depth's square).
uniform vec2 misplaced;
// Most that a stored depth differs from what was to be stored (depth_encoding.h), and of a spot the map's ends along the light.
uniform float depth_step;
uniform vec2 depth_ends;
// Units in the last place that rounding costs a depth, drawn and asked for.
const float kRounding = 16 * 1.2e-7;

// Side of a texel in the light plane.
uniform vec2 texel_side;
// Against the view, and the area of a pixel at depth 1 along it.
uniform vec3 view_back;
uniform float pixel_area;

vec3 to_light(vec3 from_eye) { return spot ? normalize(light_from_eye - from_eye) : light_back; }

// Share of a spot's light that goes this way.
float in_cone(vec3 to_light) { return spot ? smoothstep(cone.y, cone.x, dot(to_light, light_back)) : 1; }

// The receiver at a surface point with this normal, which faces the light.
Receiver receiver_at(vec3 from_eye, vec3 normal, vec3 to_light) {
    vec4 point = texel_from_eye * vec4(from_eye, 1);
    // What lies far before a warped map's near end is off the map, and stays so: it has no texel where w is 0.
    if (warped) point.w = max(point.w, 0.5);
    vec3 texel = spot || warped ? point.xyz / point.w : point.xyz;
    // Steeper than 87° (1 : 20) half a subpixel moves the plane by more than a texel's side, and no light arrives.
    normal += max(0.05 - dot(normal, to_light), 0) * to_light;
    vec3 plane = mat3(texel_plane_from_eye) * normal;
    if (spot || warped) plane -= dot(normal, from_eye) * texel_plane_from_eye[3].xyz;
    vec2 slope = -plane.xy / plane.z;
    // The depth stored for a texel is that of the caster's plane, up to where its vertices were moved, rounding, and the step of
    // what depths are stored as.
    float steepness = abs(slope.x) + abs(slope.y);
    float depth_error = spot ? misplaced.y / (point.w * point.w) : misplaced.y;
    float nearness = warped ? 1 / max(point.w, 1) : 1;
    float depth = texel.z;
    float tolerance = steepness * misplaced.x + depth_error + kRounding + depth_step;
    if (linear_depth) {
        depth = -depth_ends.y / point.w;
        float change = (depth_ends.y - depth_ends.x) / depth_ends.x;
        slope *= change;
        tolerance = (steepness * misplaced.x + depth_error) * change - depth * kRounding;
    }
    return Receiver(texel.xy, depth, slope, tolerance, vec2(nearness, nearness * nearness));
}

// `covered` at a surface point: its pixel's area on the surface is pixel_area·z³/|n·p|, z being p's depth along the view. Across a
// directional light it is smaller by n·light; as a spot sees it, in tangents, by its own n·(p − light)/depth³.
float covered_at(vec3 from_eye, vec3 facet) {
    float depth = -dot(view_back, from_eye);
    float area = pixel_area * depth * depth * depth / max(-dot(facet, from_eye), 1e-30);
    if (!spot) return area * max(dot(facet, light_back), 0);
    vec3 from_light = from_eye - light_from_eye;
    float light_depth = max(-dot(light_back, from_light), 1e-30);
    return area * max(-dot(facet, from_light), 0) / (light_depth * light_depth * light_depth);
}

// Visibility of the light at a surface point; 0 where its facet is turned away (it is in its own shadow, no map is needed to
// know) and outside a spot's cone.
float light_at(vec3 from_eye, vec3 facet, vec3 to_light) {
    float facing = dot(facet, to_light);
    if (facing <= 0 || in_cone(to_light) <= 0) return 0;
    covered = covered_at(from_eye, facet);
    footprint = sqrt(covered / max(facing, 0.05) / 2);
    return visibility(receiver_at(from_eye, facet, to_light));
}

// Depth of the receiver's plane at four points of the map, less what rounding may have added: what the depths stored
// there compare with.
vec4 plane_depth(Receiver receiver, vec4 x, vec4 y) {
    return receiver.depth - receiver.tolerance + receiver.slope.x * (x - receiver.texel.x) +
           receiver.slope.y * (y - receiver.texel.y);
}

// Which depths read from the map leave these lit. Depths beyond the map's far end count as its end, where empty texels
// are: behind any caster, and lit where there is none.
vec4 lit(vec4 depth, vec4 stored) {
    if (!linear_depth) return step(min(depth, 1), stored);
    vec4 along = -depth_ends.y / min(depth, -1);
    return step((along - depth_ends.x) / (depth_ends.y - depth_ends.x) - depth_step, stored);
}

// The depth stored at a texel; 1, as in all empty texels, beyond the map.
float stored_at(vec2 texel) {
    return texelFetch(shadow_map, ivec2(clamp(texel, vec2(-1), map_size)) + kGuard, 0).r;
}

// Whether the light reaches the receiver past what the map holds at the texel around a point.
float lit_at(Receiver receiver, vec2 point) {
    vec2 texel = floor(point);
    vec2 centre = texel + 0.5;
    return lit(plane_depth(receiver, vec4(centre.x), vec4(centre.y)), vec4(stored_at(texel))).x;
}
