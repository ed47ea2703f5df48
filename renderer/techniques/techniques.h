// The list of shadow techniques.
#pragma once

#include <span>
#include <string>

#include "renderer/techniques/technique.h"

namespace stairstep {

std::span<const TechniqueEntry> techniques();

/// Throws InputError that lists the names there are.
const TechniqueEntry& technique_named(const std::string& name);

}  // namespace stairstep
