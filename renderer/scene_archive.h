// An imported scene as bytes, from one process of this program to another of the same; not a file format.
#pragma once

#include <string>
#include <string_view>

#include "renderer/scene_import.h"

namespace stairstep {

std::string archive_of(const ImportedScene& imported);

/// The same scene again. Throws std::runtime_error where the bytes aren't an archive, or one of a scene that importing
/// never makes: with indices that lead nowhere or numbers out of range. Takes memory in proportion to the bytes.
ImportedScene scene_from_archive(std::string_view bytes);

}  // namespace stairstep
