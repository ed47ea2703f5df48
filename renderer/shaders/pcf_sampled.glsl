// Percentage-closer filtering by taps (Reeves et al. 1987); taps.glsl goes before.

// Half-width of the filter, texels; of a warped map, where they are smallest.
uniform vec2 filter_radius;

float visibility(Receiver receiver) { return lit_share(receiver, filter_radius * receiver.scale); }
