// Scenes from model files, through Assimp: glTF, OBJ, Collada, FBX and some forty more.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/light.h"
#include "renderer/scene.h"
#include "renderer/view.h"

namespace stairstep {

struct ImportedScene {
    Scene scene;
    /// Perspective cameras and lights of the file, in world space; see imported_views.h for what became of each.
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    /// What the picture will lack, in words: a texture that is missing, say.
    std::vector<std::string> warnings;
};

/// Reads a model with its node transforms applied and normals made where it has none; points and lines are
/// left out. Textures may lie beside the model or inside it. It is read in a child process, as damaged files crash some
/// importers. Throws InputError, naming the file, for one that is missing, damaged, without triangles or
/// without extent, has a coordinate that is not finite or beyond ±10¹², or wants over 4 GiB or over 5 s and another 5 s
/// per MiB of processor time while it is read; FailureError where no process can be made.
ImportedScene import_scene(const std::filesystem::path& path);

}  // namespace stairstep
