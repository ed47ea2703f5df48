// An imported scene as bytes, from one process of this program to another of the same; not a file format.
#pragma once

#include <string>
#include <string_view>

#include "renderer/scene_import.h"

namespace stairstep {

std::string archive_of(const ImportedScene& imported);

/// The same scene again. Throws std::runtime_error where the bytes aren't an archive, or one whose indices lead nowhere.
ImportedScene scene_from_archive(std::string_view bytes);

}  // namespace stairstep
