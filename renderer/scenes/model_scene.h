// A model as a scene with motions: a ground under it, a camera that frames it and its shadow, a sun that goes around it.
#pragma once

#include <string>

#include "renderer/scene_import.h"
#include "renderer/scene_state.h"

namespace stairstep {

/// The model on a ground. At time 0 the camera looks from azimuth 35°, elevation 24°, and the light comes from −50°, 48°;
/// the caster's motion turns the whole model a quarter about the vertical through its middle, as one mover; the camera
/// walks 40° around it and a quarter nearer. The radius is 2.5 % of the diagonal of the model's bounds. Cameras and
/// lights of the file are left for others to use.
AnimatedScene animated_scene_from(ImportedScene imported, const std::string& name);

}  // namespace stairstep
