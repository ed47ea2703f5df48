// A slice of the view, for pictures whose light comes in several: which pixels this pass is for. `const bool sliced` goes before.

// Along the view: from the first to just below the second.
uniform vec2 slice;

// Whether another pass lights this surface. What shows nothing is the first slice's.
bool is_others(Surface surface) {
    if (!sliced) return false;
    float depth = surface.facet == vec3(0) ? -1 : -dot(view_back, surface.from_eye);
    return depth < slice.x || depth >= slice.y;
}
