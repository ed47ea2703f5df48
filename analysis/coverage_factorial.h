// What intervals cover over a whole factorial of studies, not one change at a time (coverage.h):
//
//   between-observer SD .05, .16, .30 × lapses .02, .05 × steepness β 2, 3.5, 5        18 populations
//   × observers 5, 10, 20 × texel sizes {10, 20}, {5, 10, 20, 30}                      108 cells
//
// Fits take β to be about 3 and lapses to be rare: 2, 5 and .05 are wrong slopes and more lapses than expected.
//
// A population is simulated once, with 20 observers and four sizes, and the smaller studies are parts of it: the first
// observers, two of the sizes. Observers are independent, and so are an observer's tracks where an engine shares no evidence
// between them and observers neither tire nor learn, so that each part is distributed as a study of its own. Cells of one
// population share their luck with each other; within a cell all studies are independent, which is what a cell's standard error
// is about.
//
// Study i of the p-th population (of all 18) has the seed Random(seed).stream(p).stream(i).bits() >> 1.
//
// Anchor: each part's estimates are those of `fit_law` on its trials.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/coverage.h"

namespace stairstep {

struct FactorialPopulation {
    double between_observer_sd = 0.16;
    double lapse = 0.02;
    double beta = 3.5;

    bool operator==(const FactorialPopulation&) const = default;
};

/// `all` are the 18. `third` are 6 of them that hold each level of a factor, and each pair of a lapse rate with another factor's
/// level, equally often.
enum class FactorialShare { all, third };
std::vector<FactorialPopulation> factorial_populations(FactorialShare share);

constexpr int kFactorialObservers[]{5, 10, 20};
/// The texel sizes of studies, px: two of them and all.
const std::vector<std::vector<double>>& factorial_sizes_px();

struct FactorialSettings {
    /// Studies a population, ≥ 2.
    int studies = 1000;
    /// How many of them are bootstrapped as well, and with how many replicates; 0 leaves bootstraps out.
    int bootstrap_studies = 300;
    int replicates = 500;
    uint64_t seed = 1;
    /// Threads, 0 for one a core; the result doesn't depend on it.
    int jobs = 0;
    double p_threshold = 0.82;
};

/// One cell.
struct FactorialCell {
    FactorialPopulation population;
    int observers = 10;
    std::vector<double> texels_px;
    std::vector<MethodCoverage> methods;
    /// Studies from which no law could be fitted.
    int failed = 0;
    /// Share of tracks that don't bound their threshold, and share of studies where `fit` warns about its interval.
    double unbounded = 0;
    double warned = 0;
};

/// The cells of one population: six. `design` gives engine, task and trials. Throws InputError for an engine whose tracks share
/// evidence. `done` is called, from any thread, after each study.
std::vector<FactorialCell> factorial_coverage(
    const FactorialPopulation& population, const Design& design, const FactorialSettings& settings,
    const std::function<void()>& done = [] {});

/// The study that a population's parts are parts of.
PlantedStudy factorial_study(const FactorialPopulation& population, const Design& design);

}  // namespace stairstep
