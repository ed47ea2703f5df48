// What a light does to the surfaces that each tile of pixels has stored: reaches none of them, 0; lights some, 1; may shade one,
// 2 (shadow_query.h). surface_stored.glsl goes before.

layout(binding = 0) uniform sampler2D tile_point_low;
layout(binding = 1) uniform sampler2D tile_point_high;
layout(binding = 2) uniform sampler2D tile_normal_low;
layout(binding = 3) uniform sampler2D tile_normal_high;

// Pixels of a tile's side, and from one that is looked at to the next.
uniform int side_px;
uniform int step_px;
// Where the light's answers begin.
uniform int first_row;
uniform vec3 view_back;

uniform int is_spot;
// The axes of the light plane, and against the light.
uniform vec3 light_right;
uniform vec3 light_up;
uniform vec3 light_back;
// Eye space, of a spot.
uniform vec3 light_place;
uniform float cone_cosine;
uniform vec2 slice;
// How far the technique looks: everywhere, or this far and by so much farther for each unit of depth above the nearest caster's.
uniform int looks_anywhere;
uniform float constant_reach;
uniform float softness;
// Depth of the first caster; a spot's from the light, a directional light's from the eye.
uniform float nearest;

uniform int box_count;

struct Box {
    vec3 axis_x;
    float half_x;
    vec3 axis_y;
    float half_y;
    vec3 axis_z;
    float half_z;
    // Eye space.
    vec3 centre;
    // World units of a length in the light plane, at its far end.
    float reach_factor;
    // By how much it is widened along its axes for each such unit.
    vec3 spread;
    float rounding;
};

layout(std140, binding = 0) uniform Boxes { Box boxes[128]; };

out uint answer;

// Roundings, of a direction's cosine and of a place's distance.
const float kRounding = 1e-6;

// Whether some point in the bounds, with some normal in theirs, faces the light and is within its cone.
bool may_light(vec3 low, vec3 high, vec3 normal_low, vec3 normal_high) {
    if (low.x > high.x) return false;
    // From the points to the light.
    vec3 way_low = is_spot != 0 ? light_place - high : light_back;
    vec3 way_high = is_spot != 0 ? light_place - low : light_back;
    vec3 most = max(max(normal_low * way_low, normal_low * way_high), max(normal_high * way_low, normal_high * way_high));
    float length_most = length(max(abs(way_low), abs(way_high)));
    bool faces = most.x + most.y + most.z > -2 * kRounding * length_most;
    if (is_spot == 0) return faces;
    vec3 back = max(light_back * way_low, light_back * way_high);
    float length_least = length(max(max(way_low, -way_high), vec3(0)));
    return faces && back.x + back.y + back.z > cone_cosine * length_least - 2 * kRounding * length_most;
}

// A surface point as the light meets it.
struct Met {
    vec3 from_eye;
    // Towards the light, and how far away that is.
    vec3 towards;
    float distance;
    // As receiver.glsl tilts it where it is too steep.
    vec3 normal;
    // How far the technique looks around the point.
    float reach;
    // How far its plane may fall away from the light within one unit to the side.
    float fall;
};

// Whether a caster in the box may darken the point.
bool may_shade(Box box, Met met) {
    mat3 axes = mat3(box.axis_x, box.axis_y, box.axis_z);
    vec3 half_size = vec3(box.half_x, box.half_y, box.half_z);
    vec3 centre = box.centre - met.from_eye;
    float above = dot(met.normal, centre) + dot(abs(met.normal * axes), half_size);
    float reach = met.reach * box.reach_factor;
    vec3 widened = half_size + reach * box.spread + box.rounding + kRounding * length(met.from_eye);
    vec3 middle = centre * axes;
    vec3 speed = met.towards * axes;
    speed = mix(speed, vec3(1e-12), lessThan(abs(speed), vec3(1e-12)));
    vec3 one = (middle - widened) / speed;
    vec3 other = (middle + widened) / speed;
    vec3 first = min(one, other);
    vec3 last = max(one, other);
    float enters = max(max(first.x, first.y), first.z);
    float leaves = min(min(last.x, last.y), last.z);
    return above > kRounding * (length(met.from_eye) + length(box.centre)) && enters <= min(leaves, met.distance) &&
           leaves >= -reach * met.fall;
}

uint answer_of(Surface surface) {
    if (surface.facet == vec3(0)) return 0u;
    float view_depth = -dot(view_back, surface.from_eye);
    if (view_depth < slice.x || view_depth >= slice.y) return 0u;
    vec3 to_spot = light_place - surface.from_eye;
    vec3 towards = is_spot != 0 ? normalize(to_spot) : light_back;
    float facing = dot(surface.facet, towards);
    if (facing <= -kRounding) return 0u;
    if (is_spot != 0 && dot(towards, light_back) <= cone_cosine - kRounding) return 0u;
    if (box_count == 0) return 1u;
    if (looks_anywhere != 0) return 2u;

    float depth = is_spot != 0 ? dot(light_back, to_spot) : -dot(light_back, surface.from_eye);
    float softening = is_spot != 0 ? 1 / nearest - 1 / depth : depth - nearest;
    vec3 normal = surface.facet + max(0.05 - facing, 0) * towards;
    float fall = (abs(dot(normal, light_right)) + abs(dot(normal, light_up))) / max(facing, 0.05);
    Met met = Met(surface.from_eye, towards, is_spot != 0 ? length(to_spot) : 1e30, normal,
                  constant_reach + softness * max(softening, 0), fall);
    for (int i = 0; i < box_count; ++i) {
        if (may_shade(boxes[i], met)) return 2u;
    }
    return 1u;
}

void main() {
    ivec2 tile = ivec2(gl_FragCoord.xy) - ivec2(0, first_row);
    bool lights = may_light(texelFetch(tile_point_low, tile, 0).xyz, texelFetch(tile_point_high, tile, 0).xyz,
                            texelFetch(tile_normal_low, tile, 0).xyz, texelFetch(tile_normal_high, tile, 0).xyz);
    ivec2 end = textureSize(planes, 0) - 1;
    int per_side = side_px / step_px;
    // A loop that isn't entered costs nothing, where a branch around one may be flattened.
    int pixels = lights ? per_side * per_side : 0;
    answer = 0u;
    for (int k = 0; k < pixels && answer < 2u; ++k) {
        ivec2 pixel = side_px * tile + step_px * ivec2(k % per_side, k / per_side);
        answer = max(answer, answer_of(surface_at(min(pixel, end))));
    }
}
