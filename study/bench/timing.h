// What a trial costs, suggest and update, and what it costs in Psychtoolbox on the same machine at the same time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/bench/bench_table.h"

namespace stairstep {

/// Where Debian's psychtoolbox-3-common puts it.
inline constexpr const char* kPsychtoolboxFolder = "/usr/share/psychtoolbox-3";

struct TimingSettings {
    /// Tracks of 60 trials whose times' median is taken, ≥ 5; slow engines do a tenth, at least 5.
    int tracks = 300;
    uint64_t seed = 1;
    std::filesystem::path psychtoolbox = kPsychtoolboxFolder;
};

/// Times of Psychtoolbox, or why there are none.
struct PsychtoolboxTimes {
    /// A track: seconds for QuestQuantile and QuestUpdate together, mean over its trials.
    std::vector<double> track_s{};
    std::string missing{};
};

/// Runs tracks of `trials` trials under Octave with Psychtoolbox's defaults on 501 points, timed inside Octave.
PsychtoolboxTimes time_psychtoolbox(const std::filesystem::path& psychtoolbox, int tracks, int trials, uint64_t seed);

/// Columns engine, tracks, us_per_trial, psychtoolbox_ratio: medians over tracks. Bars: Quest 2 µs and 500 times faster than
/// Psychtoolbox, psi-marginal 300 µs, law-directed 5,000 µs.
BenchTable measure_times(const TimingSettings& settings);

}  // namespace stairstep
