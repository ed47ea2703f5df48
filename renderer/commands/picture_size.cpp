#include "renderer/commands/picture_size.h"

#include <cmath>
#include <vector>

#include "stimuli/error.h"
#include "stimuli/number.h"
#include "stimuli/stimulus.h"

namespace stairstep {

std::optional<int> side_of(const std::string& text) {
    const auto number = parse_number(text);
    if (!number || !(*number >= 1 && *number <= kLargestSide) || *number != std::floor(*number)) return std::nullopt;
    return static_cast<int>(*number);
}

std::pair<int, int> picture_size_of(const std::string& flag, const std::string& text) {
    const std::vector<std::string> sides = split(text, 'x');
    const std::optional<int> width = sides.size() == 2 ? side_of(sides[0]) : std::nullopt;
    const std::optional<int> height = sides.size() == 2 ? side_of(sides[1]) : std::nullopt;
    if (!width || !height) {
        throw InputError(flag, "\"" + text + "\" is no image size", "write WIDTHxHEIGHT, each 1 to 16384, as 1280x720");
    }
    return {*width, *height};
}

}  // namespace stairstep
