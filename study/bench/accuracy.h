// How accurate the engines' thresholds are, and whether their 95 % intervals hold what they say, by simulated tracks
// (study/bench/simulated_tracks.h).
//
// No method can do better, on average over thresholds from the prior, than
//
//   SD = 1/√(n·I* + 1/σ₀²),    I* = largest_information(shape) of study/engines/quest.h     (van Trees' inequality)
//
// .0527, .0374, .0306 after 20, 40, 60 trials for β 3.5, γ ½, δ .01, p_T .82, σ₀ .5.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "study/bench/bench_table.h"
#include "study/bench/simulated_tracks.h"

namespace stairstep {

/// An engine by name, with the model and the prior of `TrackSimulation`'s defaults.
struct BenchMethod {
    std::string name;
    std::function<std::vector<std::vector<TrackResult>>(const TrackSimulation&)> simulate;
    /// Of how many runs one is done: more than 1 for what takes milliseconds a trial.
    int every = 1;
};

/// Psychtoolbox's QUEST, Quest with each placement, minimum entropy, psi-marginal, staircases, constant stimuli.
std::vector<BenchMethod> bench_methods();

struct AccuracySettings {
    /// Simulated tracks a method, ≥ 40; psi-marginal does a fifth of them, and coverage takes a
    /// twentieth an observer, at least 20.
    int runs = 40000;
    uint64_t seed = 1;
    /// Threads, 0 for one a core.
    int jobs = 0;
};

/// The smallest SD that n trials allow.
double fisher_bound(const PsychometricShape& shape, double guess_sd, int trials);

/// Columns method, trials, runs, rmse, rmse_se, bias, bias_se, robust_sd, bound, rmse_over_bound. The bar is what minimum
/// entropy came to in another implementation, .105, .0536, .0381 over 2,000 runs.
BenchTable measure_accuracy(const AccuracySettings& settings);

/// Columns method, beta, delta, bias, trials, runs, coverage, coverage_se, threshold_bias, rmse: intervals after 40 and 60 trials
/// of observers whose shape is not what the engine expects. The bar is .92 for psi-marginal with beta from 2 to 5.
BenchTable measure_coverage(const AccuracySettings& settings);

}  // namespace stairstep
