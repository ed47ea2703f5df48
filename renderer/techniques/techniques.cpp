#include "renderer/techniques/techniques.h"

#include <array>

#include "stimuli/error.h"

namespace stairstep {

// Each is defined in the file of its name.
TechniqueEntry none_technique();
TechniqueEntry hard_technique();
TechniqueEntry pcf_technique();
TechniqueEntry pcss_technique();
TechniqueEntry vsm_technique();
TechniqueEntry esm_technique();

std::span<const TechniqueEntry> techniques() {
    static const std::array list{none_technique(), hard_technique(), pcf_technique(),
                                 pcss_technique(), vsm_technique(),  esm_technique()};
    return list;
}

const TechniqueEntry& technique_named(const std::string& name) {
    std::string names;
    for (const TechniqueEntry& entry : techniques()) {
        if (entry.name == name) return entry;
        names += (names.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw InputError("--technique", "\"" + name + "\" is no technique", "use one of " + names);
}

}  // namespace stairstep
