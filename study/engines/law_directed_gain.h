// What LawDirected gains: simulated rounds of one observer, five ways to run and pool them, how far each ends from the
// planted law.
//
//   law-directed        LawDirected chooses track and intensity; its own estimate
//   shared-placement    a random track, at its posterior mean given all tracks, + the fixed offset; LawDirected's estimate
//   quest-hierarchical  a random track, where its own Quest suggests; the same answers put into LawDirected for an estimate
//   quest-weighted      same trials; the Quests' means, weighted with 1/(σ_e² + sd_k²)
//   quest-mean          same trials; the plain mean of the Quests' means
//
// Between the first and the second lies what the choice of track and intensity gains; between the second and the third,
// what placing with all tracks' answers gains; between the third and the rest, better pooling, which today's trials
// could have without any new engine.
//
// Measured, 150 observers, β 3.5, δ .02, both σ_e .04, RMSE of log10 c after 20, 40, 80, 160 trials (SE 5 to 10 %):
//
//   law-directed        .105  .064  .037  .028       shared-placement    .107  .061  .038  .028
//   quest-hierarchical  .164  .082  .057  .036       quest-weighted      .180  .106  .054  .033
//
// So independent tracks need 1.4 to 1.9 times the trials for equal errors, and nearly all of that comes from placing with
// every track's answers: four tracks search for the threshold once instead of four times. Choosing track and intensity by
// the expected variance adds nothing at β 3.5 (.9 to 1.2 against shared-placement, within errors), whose fixed offset is
// made for that slope; with 80 trials it adds 1.7 ± .2 at β 5, 1.1 ± .1 at β 2, and with 20 to 40 at β 2 it needs up to a
// sixth more. The gain ends where the
// deviations' own σ_e/√tracks, .02 here, is all that is left. An early lapse misleads tracks that share more than tracks that
// don't: with a fixed slope and δ .01 against a true δ of .06 the sharing methods are no better than independent ones.
// A fixed β of 3.5 against a true 2 (σ_e .04) leaves 95 % intervals that cover 61 % after 160 trials; the usual shapes 91 %.
// Where the tracks deviate by .08, twice the σ_e assumed, those cover 86 to 88 %.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "study/engines/law_directed.h"

namespace stairstep {

enum class GainMethod { law_directed, shared_placement, quest_hierarchical, quest_weighted, quest_mean };
constexpr int kGainMethods = 5;
const char* to_string(GainMethod method);

struct GainSettings {
    /// Also says how θ is drawn: normal with `guess` and `guess_sd`. A coarser grid than the study's, for speed.
    LawDirectedSettings engine{.guess = -0.477, .grain = 0.02, .range = 4};
    /// The observer: true σ_e, log10 units, ≥ 0, and psychometric function. Quest and the offset of the shared placement
    /// always take β 3.5 and δ .01.
    double true_deviation_sd = 0.04;
    PsychometricShape observer{.beta = 3.5, .gamma = 0.5, .delta = 0.02};
    /// Trials in all tracks together, ascending, ≥ 1: after how many the estimates are compared.
    std::vector<int> checkpoints{20, 40, 80, 160};
    /// Simulated observers, at least 20; the same for all methods.
    int runs = 400;
    uint64_t seed = 1;
    /// Threads, 0 for one a core. The result doesn't depend on it.
    int jobs = 0;
};

/// How far −log10 c is from the truth, log10 units, and how sure the simulation is of it (standard errors).
struct GainRow {
    GainMethod method{};
    int trials = 0;
    double rmse = 0;
    double rmse_se = 0;
    double bias = 0;
    double bias_se = 0;
    /// Share of 95 % intervals that hold the truth.
    double coverage = 0;
    double coverage_se = 0;
};

/// How many trials a method needs for the RMSE that law-directed has after `trials`.
struct GainRatio {
    GainMethod method{};
    int trials = 0;
    /// needed/trials, interpolated; nothing if not even the last checkpoint's trials are enough.
    std::optional<double> ratio;
    /// By leaving out each twentieth of the runs (jackknife); rough, as errors fall slowly and not evenly.
    double ratio_se = 0;
};

struct GainTable {
    std::vector<GainRow> rows;
    /// For each checkpoint but the last.
    std::vector<GainRatio> ratios;
};

/// Throws InputError for settings out of their ranges.
GainTable simulate_gain(const GainSettings& settings);

}  // namespace stairstep
