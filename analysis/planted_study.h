// Studies whose truth is known: a law is planted in simulated observers, who go through real sessions with a real engine into a
// real store, and what comes out of it is fitted as any study is. What coverage.h and power.h count over.
#pragma once

#include <cstdint>
#include <vector>

#include "study/design.h"
#include "study/simulated_observer.h"

namespace stairstep {

struct PlantedStudy {
    int observers = 10;
    Design design;
    SimulatedPopulation population;

    /// The median observer's slope in a condition.
    double true_slope(Pattern pattern, double contrast) const { return median_slope(population, pattern, contrast); }
};

/// The study's trials that are evidence. The same seed gives the same study. Throws InputError for a design or population that
/// isn't valid.
std::vector<Trial> simulate_study(const PlantedStudy& study, uint64_t seed);

}  // namespace stairstep
