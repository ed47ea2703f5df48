// A source of stimuli that draws them with a shadow map, for programs that work with many threads.
#pragma once

#include <functional>
#include <vector>

#include "stimuli/stimulus.h"

namespace stairstep {

/// Luminance C·V of every pixel, row by row from the top: as stimuli/stimulus.h's luminance(), which is the exact source.
using StimulusSource = std::function<std::vector<double>(const Stimulus&)>;

/// Draws in OSMesa by renderer/stimulus_renderer.h, lines exactly: no shadow map ever sampled those. Any thread may call it,
/// several at once; as a GL context is one thread's alone, a thread of the source's own draws for all, one by one. Throws
/// as StimulusRenderer, and FailureError where there is no OpenGL.
StimulusSource shadow_map_source();

}  // namespace stairstep
