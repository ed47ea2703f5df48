#include "study/design.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace stairstep {
namespace {

/// Row of a balanced Latin square of `size` treatments (Williams 1949): 0, 1, n−1, 2, n−2, … shifted by the row.
std::vector<int> latin_square_row(int size, int row) {
    std::vector<int> order;
    for (int place = 0; place < size; ++place) {
        const int zigzag = place % 2 == 1 ? (place + 1) / 2 : (size - place / 2) % size;
        order.push_back((zigzag + row) % size);
    }
    return order;
}

}  // namespace

std::vector<Round> rounds_for(const Design& design, int observer_index) {
    std::vector<Round> rounds;
    for (const Pattern pattern : design.patterns) {
        for (const double contrast : design.contrasts) {
            Round round;
            for (const double texel_px : design.texels_px) {
                round.tracks.push_back({pattern, design.kernel, contrast, texel_px});
            }
            rounds.push_back(round);
        }
    }
    const int count = static_cast<int>(rounds.size());
    std::vector<Round> ordered;
    for (const int i : latin_square_row(count, observer_index % count)) ordered.push_back(rounds[i]);
    return ordered;
}

QuestSettings quest_settings(const Design& design) {
    QuestSettings settings = design.quest;
    settings.guess = -std::log10(design.guess_radius_texels);
    return settings;
}

nlohmann::ordered_json to_json(const Design& design) {
    nlohmann::ordered_json patterns = nlohmann::ordered_json::array();
    for (const Pattern pattern : design.patterns) patterns.push_back(name(pattern));
    const QuestSettings& quest = design.quest;
    return {{"name", design.name},
            {"patterns", patterns},
            {"contrasts", design.contrasts},
            {"texels_px", design.texels_px},
            {"kernel", name(design.kernel)},
            {"task", "one interval: was the original a line? lines on half the trials of each track"},
            {"engine",
             {{"name", "quest"},
              {"guess_radius_texels", design.guess_radius_texels},
              {"guess_sd", quest.guess_sd},
              {"p_threshold", quest.shape.p_threshold},
              {"beta", quest.shape.beta},
              {"gamma", quest.shape.gamma},
              {"delta", quest.shape.delta},
              {"grain", quest.grain},
              {"range", quest.range}}},
            {"stop",
             {{"least_trials", design.stop.least_trials},
              {"most_trials", design.stop.most_trials},
              {"converged_sd", design.stop.converged_sd}}},
            {"radius_px", {design.smallest_radius_px, design.largest_radius_px}}};
}

}  // namespace stairstep
