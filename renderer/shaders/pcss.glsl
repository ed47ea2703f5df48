// Percentage-closer soft shadows (Fernando 2005) by taps; taps.glsl goes before. Set 0 is the filter's, 1 the search's.

// Half-width of a penumbra's filter, texels, for each unit between the stored depths of receiver and caster.
uniform vec2 softness;
// c: half-width in texels of the narrowest filter that hides its texels.
uniform float law_slope;

float visibility(Receiver receiver) {
    // Casters lie beyond depth 0: none further off to the side can be in the way.
    vec2 search = softness * receiver.depth;
    vec4 motion = tap_motion(1);
    float blockers = 0;
    float sum = 0;
    for (int i = 0; i < tap_sets[1].count; ++i) {
        vec2 texel = floor(receiver.texel + moved(taps1[i], motion) * search);
        float stored = stored_at(texel);
        float blocks = 1 - lit(plane_depth(receiver, vec4(texel.x + 0.5), vec4(texel.y + 0.5)), vec4(stored)).x;
        blockers += blocks;
        sum += blocks * stored;
    }
    // At contacts a texel's width is what the map can show.
    vec2 radius = max(softness * (receiver.depth - sum / max(blockers, 1)), 0.5);
    float share = lit_share(receiver, radius);
    if (blockers > 0 && share > 0 && share < 1) {
        needed_texel = max(min(radius.x * texel_side.x, radius.y * texel_side.y) / law_slope, footprint);
    }
    return blockers == 0 ? 1 : share;
}
