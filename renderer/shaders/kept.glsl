// Nothing has moved: visibility as the last frame found it.

layout(binding = 6) uniform sampler2D kept;

float visibility(Receiver receiver) { return texelFetch(kept, ivec2(gl_FragCoord.xy), 0).r; }
