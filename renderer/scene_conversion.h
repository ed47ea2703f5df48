// From Assimp's scene to the renderer's: node transforms applied, materials, textures, cameras and lights taken over.
//
// Assimp checks little of what an importer makes: numbers may be NaN, indices lead nowhere, nodes nest without end.
#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <string>

#include "renderer/scene_import.h"

namespace stairstep {

/// Why a model is refused, and what would do: the last two parts of an InputError, whose first is the file.
struct SceneRejection {
    std::string problem;
    std::string remedy;
};

/// The scene of a model that lies at `path`, beside which its textures are sought. Throws SceneRejection for one without
/// triangles or without extent, a coordinate that is not finite or beyond ±10¹², an index that leads nowhere, nodes nested over
/// 1000 deep, or over 2²⁷ vertices.
ImportedScene scene_of(const aiScene& source, const std::filesystem::path& path);

}  // namespace stairstep
