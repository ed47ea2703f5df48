// Of each tile of 8 × 8 pixels, which lights its stored surfaces face, and which may shade them: a bit a light (shadow_query.h).
// surface_stored.glsl goes before.

// Pixels from one that is looked at to the next: 1, 2, 4 or 8.
uniform int step_px;
// Lights that are known to shade something: not asked about.
uniform int known;
uniform int light_count;
uniform vec3 view_back;

struct Light {
    // The axes of the light plane.
    vec3 right;
    float reach;
    vec3 up;
    float softness;
    vec3 back;
    float cone_cosine;
    vec3 from_eye;
    // Depth of the first caster; a spot's from the light, a directional light's from the eye.
    float nearest;
    vec2 slice;
    int first_box;
    int box_count;
    int is_spot;
    int looks_anywhere;
    ivec2 unused;
};

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

layout(std430, binding = 4) readonly buffer Lights { Light lights[]; };
layout(std430, binding = 5) readonly buffer Boxes { Box boxes[]; };

out uvec2 lit_and_shaded;

const int kSide = 8;
// Roundings, of a direction's cosine and of a place's distance.
const float kRounding = 1e-6;

// A surface point as a light meets it.
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

void main() {
    ivec2 end = textureSize(planes, 0) - 1;
    ivec2 first_pixel = kSide * ivec2(gl_FragCoord.xy);
    int per_side = kSide / step_px;
    uint lit = 0u;
    uint shaded = 0u;
    for (int k = 0; k < per_side * per_side; ++k) {
        Surface surface = surface_at(min(first_pixel + step_px * ivec2(k % per_side, k / per_side), end));
        if (surface.facet == vec3(0)) continue;
        float view_depth = -dot(view_back, surface.from_eye);
        for (int i = 0; i < light_count; ++i) {
            uint bit = 1u << i;
            if (((uint(known) | shaded) & bit) != 0u) continue;
            Light light = lights[i];
            if (view_depth < light.slice.x || view_depth >= light.slice.y) continue;
            vec3 to_spot = light.from_eye - surface.from_eye;
            vec3 towards = light.is_spot != 0 ? normalize(to_spot) : light.back;
            float facing = dot(surface.facet, towards);
            if (facing <= -kRounding) continue;
            if (light.is_spot != 0 && dot(towards, light.back) <= light.cone_cosine - kRounding) continue;
            lit |= bit;

            float depth = light.is_spot != 0 ? dot(light.back, to_spot) : -dot(light.back, surface.from_eye);
            float softening = light.is_spot != 0 ? 1 / light.nearest - 1 / depth : depth - light.nearest;
            vec3 normal = surface.facet + max(0.05 - facing, 0) * towards;
            float fall = (abs(dot(normal, light.right)) + abs(dot(normal, light.up))) / max(facing, 0.05);
            Met met = Met(surface.from_eye, towards, light.is_spot != 0 ? length(to_spot) : 1e30, normal,
                          light.reach + light.softness * max(softening, 0), fall);
            int count = light.looks_anywhere != 0 ? 0 : light.box_count;
            bool found = light.looks_anywhere != 0 && light.box_count > 0;
            for (int j = 0; j < count && !found; ++j) found = may_shade(boxes[light.first_box + j], met);
            if (found) shaded |= bit;
        }
    }
    lit_and_shaded = uvec2(lit, shaded);
}
