#include "renderer/shadow_settings.h"

#include <algorithm>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {

std::string skip_names() {
    std::string names;
    for (const SkipName& skip : kSkips) names += (names.empty() ? "" : ", ") + std::string(skip.name);
    return names;
}

Skips skips_without(const std::string& names) {
    Skips skips;
    if (names.empty()) return skips;
    for (const std::string& name : split(names, ',')) {
        const auto found =
            std::find_if(std::begin(kSkips), std::end(kSkips), [&](const SkipName& skip) { return skip.name == name; });
        if (name == "all") {
            for (const SkipName& skip : kSkips) skips.*skip.skip = false;
        } else if (found != std::end(kSkips)) {
            skips.*found->skip = false;
        } else {
            throw InputError("--no-skip", "\"" + name + "\" is nothing that is skipped",
                             "use one of all, " + skip_names());
        }
    }
    return skips;
}

}  // namespace stairstep
