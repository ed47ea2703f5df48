// A source of stimuli that draws them with a shadow map, for programs that work with many threads.
#pragma once

#include "stimuli/draw.h"

namespace stairstep {

/// Draws in OSMesa by renderer/stimulus_renderer.h, lines exactly: no shadow map ever sampled those. Any thread may call it,
/// several at once; as a GL context is one thread's alone, a thread of the source's own draws for all, one by one. Throws
/// as StimulusRenderer, and FailureError where there is no OpenGL.
LuminanceOf shadow_map_source();

}  // namespace stairstep
