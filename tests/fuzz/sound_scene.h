// What holds of every scene that came from a model file.
#pragma once

#include "renderer/scene_import.h"

namespace stairstep::fuzz {

/// Throws Violation unless indices lead somewhere, numbers are finite, textures have as many pixels as they say, and cameras
/// and lights are as their headers want them.
void require_sound(const ImportedScene& imported);

}  // namespace stairstep::fuzz
