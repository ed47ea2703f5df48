// The list of procedural scenes, and scenes by name or file alike.
//
// To add one: a file here with its SceneEntry, and a line in scenes.cpp. Lengths are metres; a scene stands around the
// origin, its ground at height 0.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "renderer/scene_state.h"

namespace stairstep {

/// A line of the list.
struct SceneEntry {
    std::string_view name;
    std::string_view summary;
    /// The same at every call.
    AnimatedScene (*make)();
};

std::span<const SceneEntry> scenes();

/// Throws InputError that lists the names there are.
AnimatedScene scene_named(const std::string& name);

/// The one of this name; null for a file. Throws InputError for what is neither.
const SceneEntry* scene_unless_file(const std::string& name_or_path);

/// One of the list where the name is there, else a model from a file (model_scene.h), whose warnings go to the
/// terminal. Throws InputError for what is neither.
AnimatedScene load_animated_scene(const std::string& name_or_path);

}  // namespace stairstep
