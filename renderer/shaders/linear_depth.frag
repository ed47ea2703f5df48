#version 450 core
// The depth pass of a spot whose depths are linear: what is linear over the picture is their reciprocal, so each fragment takes
// its own.

// Along the light.
uniform vec2 depth_ends;

void main() { gl_FragDepth = clamp((1 / gl_FragCoord.w - depth_ends.x) / (depth_ends.y - depth_ends.x), 0, 1); }
