// How fast a whole simulated study runs: sessions of the thesis's design, 16 tracks of 40 trials an observer, each trial stored
// before the next is planned.
#pragma once

#include <cstdint>
#include <filesystem>

#include "study/bench/bench_table.h"

namespace stairstep {

struct StudyRateSettings {
    /// ≥ 1.
    int observers = 100;
    uint64_t seed = 1;
    /// Where the database on disk is made, and removed again; the system's temporary folder if empty.
    std::filesystem::path folder{};
};

/// Columns store, observers, trials, seconds, trials_per_s, us_per_trial: without a store, in memory, on disk. Throws
/// FailureError where the disk won't take it.
BenchTable measure_study_rate(const StudyRateSettings& settings);

}  // namespace stairstep
