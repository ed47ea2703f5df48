// Work split between machines that don't talk to each other.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace stairstep {

/// Part `index` of `count`, 1 ≤ index ≤ count: item k belongs to the part k mod count + 1. Parts are disjoint, cover
/// everything, and each has a fair share of every stretch of the list.
struct Shard {
    int index = 1;
    int count = 1;

    template <typename T>
    std::vector<T> of(const std::vector<T>& items) const {
        std::vector<T> part;
        for (size_t k = static_cast<size_t>(index) - 1; k < items.size(); k += static_cast<size_t>(count)) {
            part.push_back(items[k]);
        }
        return part;
    }
};

/// "2/4" → part 2 of 4. Throws InputError for anything else; count is at most 10⁶.
Shard parse_shard(const std::string& text);

}  // namespace stairstep
