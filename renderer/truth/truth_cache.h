// Ground truth kept on disk: what took seconds to trace is read back when the same is asked again.
//
// A file `truth-<key>.exr` holds visibility as 32-bit floats. Its key is a fingerprint of 128 bits (FarmHash) over all that the
// values depend on: the triangles, which of them cast and move, the camera, the light and the movers, the picture's size, the
// samples, and kAreaLightTruthVersion. Colours, textures and shading normals are not among them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "renderer/truth/area_light_truth.h"

namespace stairstep {

/// $XDG_CACHE_HOME/stairstep, or ~/.cache/stairstep where that isn't set or is no absolute path (XDG Base Directory
/// Specification). Throws InputError where neither is known.
std::filesystem::path default_cache_folder();

/// The visibility that `make` gives, read from `path` where it is there with this description, and else written there for the
/// next time. A file that is damaged or holds something else is made anew; so it is, and a folder that can't be written, said
/// as a warning on stderr. Several processes may share a folder.
std::vector<float> cached_visibility(const std::filesystem::path& path, const std::string& description, int width,
                                     int height, const std::function<std::vector<float>()>& make);

/// 32 hexadecimal digits.
std::string truth_key(const Scene& scene, const SceneState& state, int width, int height, int samples);

/// area_light_visibility, as cached_visibility keeps it in the folder.
std::vector<float> cached_area_light_visibility(const Scene& scene, const SceneState& state, int width, int height,
                                                int samples, const std::filesystem::path& folder, int jobs = 0);

}  // namespace stairstep
