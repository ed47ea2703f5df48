// A normal that is turned towards the light where its plane is steeper than 87° (1 : 20) against it: there half a subpixel of
// the rasteriser's moves the plane by more than a texel's side, and no light arrives.
vec3 no_steeper(vec3 normal, vec3 to_light) { return normal + max(0.05 - dot(normal, to_light), 0) * to_light; }
