// Cameras and lights of a model file, from Assimp's description of them to the renderer's, in world space.
#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

#include "renderer/light.h"
#include "renderer/scene.h"
#include "renderer/view.h"

namespace stairstep {

/// The perspective cameras, with their nodes' transforms. What Assimp's header calls half the horizontal field of view is
/// all of it in its importers; the vertical one follows by the camera's aspect, 1 where the file gives none. A distance
/// of the near or far plane that can't be is made from `bounds`. Cameras that are orthographic, have a number that isn't
/// finite, no direction, or a field of view not in (0°, 180°) are left out with a warning.
std::vector<Camera> imported_cameras(const aiScene& source, const Bounds& bounds, std::vector<std::string>& warnings);

/// The lights, with their nodes' transforms. Sizes are 0 but for area lights, which become spots of 85° whose square has
/// the rectangle's area. A spot's angle is half of that in the file, all of it in glTF, and at most 85°. Point lights
/// become spots that shine on all of `bounds`, as far as 85° go, with a warning. Lights that are none of these, have a
/// number that isn't finite or no direction are left out with a warning.
std::vector<Light> imported_lights(const aiScene& source, const Bounds& bounds, std::vector<std::string>& warnings);

}  // namespace stairstep
