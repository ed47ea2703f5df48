// Scenes from model files, through Assimp: glTF, OBJ, Collada, FBX and some forty more.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/scene.h"

namespace stairstep {

struct ImportedScene {
    Scene scene;
    /// What the picture will lack, in words: a texture that is missing, say.
    std::vector<std::string> warnings;
};

/// Reads a model with its node transforms applied and normals made where it has none; points and lines are
/// left out. Throws InputError, naming the file, for one that is missing, damaged, without triangles or
/// without extent, has a coordinate that is not finite or beyond ±10¹², or wants over 4 GiB while it is read.
ImportedScene import_scene(const std::filesystem::path& path);

}  // namespace stairstep
