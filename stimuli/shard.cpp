#include "stimuli/shard.h"

#include <optional>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {

Shard parse_shard(const std::string& text) {
    const std::vector<std::string> parts = split(text, '/');
    const auto index = parts.size() == 2 ? parse_number(parts[0]) : std::nullopt;
    const auto count = parts.size() == 2 ? parse_number(parts[1]) : std::nullopt;
    const auto is_whole = [](double value) { return value >= 1 && value <= 1e6 && value == static_cast<int>(value); };
    if (!index || !count || !is_whole(*index) || !is_whole(*count) || *index > *count) {
        throw InputError("--shard", "\"" + text + "\" is no part", "write i/n with 1 <= i <= n, for example 2/4");
    }
    return {static_cast<int>(*index), static_cast<int>(*count)};
}

}  // namespace stairstep
