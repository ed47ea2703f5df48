#include "stimuli/grid.h"

#include <algorithm>
#include <string>
#include <utility>

#include "stimuli/error.h"

namespace stairstep {
namespace {

template <typename T>
void require_distinct(const char* axis, std::vector<T> values) {
    if (values.empty()) throw InputError(axis, "is empty", "list at least one value");
    std::sort(values.begin(), values.end());
    if (std::adjacent_find(values.begin(), values.end()) != values.end()) {
        throw InputError(axis, "lists a value twice", "list each value once");
    }
}

/// What the grid's patterns mean: pairs of the pattern drawn and the silhouette it belongs to.
std::vector<std::pair<Pattern, Pattern>> patterns_and_silhouettes(const std::vector<Pattern>& patterns) {
    std::vector<Pattern> silhouettes;
    std::copy_if(patterns.begin(), patterns.end(), std::back_inserter(silhouettes),
                 [](Pattern pattern) { return pattern != Pattern::line; });
    if (silhouettes.empty()) silhouettes = {Pattern::step, Pattern::stair};

    std::vector<std::pair<Pattern, Pattern>> pairs;
    for (const Pattern pattern : patterns) {
        if (pattern != Pattern::line) {
            pairs.emplace_back(pattern, pattern);
            continue;
        }
        for (const Pattern silhouette : silhouettes) pairs.emplace_back(Pattern::line, silhouette);
    }
    return pairs;
}

}  // namespace

std::vector<Stimulus> stimuli_of(const StimulusGrid& grid) {
    require_distinct("patterns", grid.patterns);
    require_distinct("kernels", grid.kernels);
    require_distinct("contrasts", grid.contrasts);
    require_distinct("texel sizes", grid.texels_px);
    require_distinct("radii", grid.radii_px);

    std::vector<Stimulus> stimuli;
    for (const auto& [pattern, silhouette] : patterns_and_silhouettes(grid.patterns)) {
        for (const KernelShape kernel : grid.kernels) {
            for (const double contrast : grid.contrasts) {
                for (const double texel_px : grid.texels_px) {
                    for (const double radius_px : grid.radii_px) {
                        stimuli.push_back({pattern,
                                           silhouette,
                                           texel_px,
                                           {kernel, radius_px},
                                           contrast,
                                           grid.width_px,
                                           grid.height_px,
                                           grid.step_reference});
                        require_valid(stimuli.back());
                    }
                }
            }
        }
    }
    return stimuli;
}

}  // namespace stairstep
