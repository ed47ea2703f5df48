#include "study/bench/gain_table.h"

#include <algorithm>

#include "stimuli/number.h"

namespace stairstep {

BenchTable measure_gain(const GainSettings& settings) {
    const GainTable gain = simulate_gain(settings);
    BenchTable table{.name = "gain",
                     .title = "Law-directed placement: error of log10 c",
                     .columns = {"method", "trials", "runs", "rmse", "rmse_se", "bias", "bias_se", "coverage",
                                 "coverage_se", "trials_ratio", "trials_ratio_se"}};
    for (const GainRow& row : gain.rows) {
        const auto ratio = std::find_if(gain.ratios.begin(), gain.ratios.end(), [&](const GainRatio& candidate) {
            return candidate.method == row.method && candidate.trials == row.trials;
        });
        BenchCell times, times_se;
        if (ratio != gain.ratios.end() && ratio->ratio) {
            times = {*ratio->ratio, 2};
            times_se = {ratio->ratio_se, 2};
        }
        table.rows.push_back({{to_string(row.method),
                               row.trials,
                               settings.runs,
                               {row.rmse, 4},
                               {row.rmse_se, 4},
                               {row.bias, 4},
                               {row.bias_se, 4},
                               {row.coverage, 3},
                               {row.coverage_se, 3},
                               times,
                               times_se}});
    }
    table.notes = {"One observer's " + std::to_string(settings.engine.tracks) +
                       " tracks, whose thresholds deviate from the law by " +
                       format_number(settings.true_deviation_sd) + " log10 units; beta " +
                       format_number(settings.observer.beta) + ", delta " + format_number(settings.observer.delta) +
                       ". `trials` are those of all tracks together.",
                   "trials_ratio is how many times the trials the method needs for law-directed's rmse; empty where "
                   "the trials at hand "
                   "aren't enough to tell.",
                   "shared-placement takes a random track and every track's answers; the quest methods run each track "
                   "by itself and "
                   "pool in the end: by the hierarchical posterior, by weights, by the plain mean."};
    return table;
}

}  // namespace stairstep
