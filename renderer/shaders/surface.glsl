// A surface point, eye space: the world's axes around the camera's eye.
struct Surface {
    vec3 from_eye;
    // The triangle's own normal, facing the viewer; 0 where there is nothing.
    vec3 facet;
    // Of the smooth surface that the triangles stand for.
    vec3 normal;
    // Linear.
    vec3 base_colour;
    // Whether it fades into the background far away.
    bool fades;
};

// A surface's normal, colour and fading in two numbers: the normal on an octahedron (Cigolle et al. 2014), 16 bits an axis; the
// colour's square roots, 10 bits each, which tell displayed levels apart; fading in the last bit.
uvec2 packed_material(vec3 normal, vec3 base_colour, bool fades) {
    vec2 fold = normal.xy / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    vec2 other = (1 - abs(fold.yx)) * mix(vec2(-1), vec2(1), greaterThanEqual(fold, vec2(0)));
    uvec3 root = uvec3(sqrt(clamp(base_colour, 0, 1)) * 1023 + 0.5);
    return uvec2(packSnorm2x16(normal.z < 0 ? other : fold), root.r | root.g << 10 | root.b << 20 | uint(fades) << 30);
}

vec3 unpacked_normal(uvec2 material) {
    vec2 fold = unpackSnorm2x16(material.x);
    vec3 normal = vec3(fold, 1 - abs(fold.x) - abs(fold.y));
    normal.xy -= max(-normal.z, 0) * mix(vec2(-1), vec2(1), greaterThanEqual(fold, vec2(0)));
    return normalize(normal);
}

vec3 unpacked_base_colour(uvec2 material) {
    vec3 root = vec3(material.y & 1023u, material.y >> 10 & 1023u, material.y >> 20 & 1023u) / 1023;
    return root * root;
}
