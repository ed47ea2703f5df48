// Sizes of pictures and maps as the command line has them.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace stairstep {

/// A whole number in [1, kLargestSide].
std::optional<int> side_of(const std::string& text);

/// "1280x720". Throws InputError that names the flag.
std::pair<int, int> picture_size_of(const std::string& flag, const std::string& text);

}  // namespace stairstep
