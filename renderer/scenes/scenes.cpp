#include "renderer/scenes/scenes.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "renderer/scenes/model_scene.h"
#include "stimuli/error.h"
#include "stimuli/io/program.h"

namespace stairstep {

// Each is defined in the file of its name.
SceneEntry crane_scene();
SceneEntry colonnade_scene();
SceneEntry city_scene();
SceneEntry clutter_scene();
SceneEntry cornell_scene();
SceneEntry fence_scene();
SceneEntry rooms_scene();

namespace {

const SceneEntry* find(const std::string& name) {
    const auto found = std::ranges::find(scenes(), name, &SceneEntry::name);
    return found == scenes().end() ? nullptr : &*found;
}

std::string names() {
    std::string list;
    for (const SceneEntry& entry : scenes()) list += (list.empty() ? "" : ", ") + std::string(entry.name);
    return list;
}

}  // namespace

std::span<const SceneEntry> scenes() {
    static const std::array list{crane_scene(),   colonnade_scene(), city_scene(), clutter_scene(),
                                 cornell_scene(), fence_scene(),     rooms_scene()};
    return list;
}

AnimatedScene scene_named(const std::string& name) {
    const SceneEntry* entry = find(name);
    if (!entry) throw InputError(name, "isn't a scene", "use " + names());
    return entry->make();
}

const SceneEntry* scene_unless_file(const std::string& name_or_path) {
    const SceneEntry* entry = find(name_or_path);
    if (!entry && !std::filesystem::exists(name_or_path)) {
        throw InputError(name_or_path, "is neither a scene nor a file", "name a model, as truck.gltf, or " + names());
    }
    return entry;
}

AnimatedScene load_animated_scene(const std::string& name_or_path) {
    if (const SceneEntry* entry = scene_unless_file(name_or_path)) return entry->make();
    ImportedScene imported = import_scene(name_or_path);
    for (const std::string& warning : imported.warnings) warn(name_or_path.c_str(), warning.c_str());
    return animated_scene_from(std::move(imported), name_or_path);
}

}  // namespace stairstep
