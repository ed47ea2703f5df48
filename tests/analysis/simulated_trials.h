// Trials of simulated observers in a design, as a fit takes them.
#pragma once

#include <string>
#include <vector>

#include "study/session.h"
#include "study/simulated_observer.h"

namespace stairstep {

inline std::vector<Trial> simulated_trials(int observers, const Design& design = {}, uint64_t seed = 7,
                                           const SimulatedPopulation& population = {},
                                           const std::string& prefix = "o") {
    std::vector<Trial> trials;
    for (int i = 0; i < observers; ++i) {
        SimulatedObserver observer(population, Random(seed).stream(static_cast<uint64_t>(i)), 0);
        Session session(design, {prefix + std::to_string(i), i, i + 1, seed});
        run_session(session, observer, {[&](const Trial& trial) { trials.push_back(trial); }});
    }
    return evidence(std::move(trials));
}

/// Two conditions and two sizes: the least that has all parts of a report.
inline Design small_design() {
    Design design;
    design.patterns = {Pattern::step, Pattern::stair};
    design.contrasts = {1};
    design.texels_px = {5, 10};
    design.width_px = 160;
    design.height_px = 120;
    return design;
}

}  // namespace stairstep
