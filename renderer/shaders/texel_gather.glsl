// The depths stored at the four texels that share a corner, from the upper left clockwise: out of the map itself. 1, as in all
// empty texels, beyond the map.

vec4 stored_around(vec2 corner) {
    return textureGather(shadow_map, (clamp(corner, vec2(-1), map_size + 1) + kGuard) * map_scale);
}
