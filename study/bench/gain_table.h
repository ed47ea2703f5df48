// The table of what law-directed placement gains (study/engines/law_directed_gain.h).
#pragma once

#include "study/bench/bench_table.h"
#include "study/engines/law_directed_gain.h"

namespace stairstep {

/// Columns method, trials, runs, rmse, rmse_se, bias, bias_se, coverage, coverage_se, trials_ratio, trials_ratio_se: the ratio
/// is how many times the trials the method needs for law-directed's RMSE.
BenchTable measure_gain(const GainSettings& settings);

}  // namespace stairstep
