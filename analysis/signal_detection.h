// Sensitivity apart from preference: d′ and criterion from counts (Green & Swets 1966; Macmillan & Creelman 2005).
//
// Yes-no. H: rate of "artifact" where one was shown, F: where a line was. With z = Φ⁻¹,
//
//   d′ = z(H) − z(F),   c = −(z(H) + z(F))/2        c > 0: inclined to say "line"
//
// Two alternatives, side by side: H and F are rates of "left" where the artifact was left or right, and an observer of the same
// sensitivity does better by √2: d′ = (z(H) − z(F))/√2. Without preference the share of right answers is Φ(d′/√2).
//
// Rates of 0 and 1 have no z. The log-linear correction (Hautus 1995) adds ½ to each count and 1 to each number of trials, always,
// not where it is needed alone: (k + ½)/(n + 1).
//
// Intervals: normal approximation with Gourevitch and Galanter's (1967) variance at the corrected rates, R(1 − R)/(n·φ(z(R))²) for
// each rate. Too wide rather than too narrow where a rate is near 0 or 1.
//
// Anchors: H = .84134, F = .15866 in many trials: d′ = 2, c = 0; 2AFC with 76.02 % right on either side: d′ = 1.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "study/trial.h"

namespace stairstep {

/// What was shown and said. For two alternatives "artifact" is "the left one is the artifact".
struct ResponseCounts {
    int hits = 0;
    int artifacts = 0;
    int false_alarms = 0;
    int lines = 0;
};

/// What the intervals are, in words.
inline constexpr std::string_view kSensitivityIntervals =
    "95 %, normal approximation, variance after Gourevitch and Galanter (1967), log-linear rates (Hautus 1995)";

struct Sensitivity {
    ResponseCounts counts;
    /// (k + ½)/(n + 1).
    double hit_rate = 0;
    double false_alarm_rate = 0;
    double d_prime = 0;
    std::pair<double, double> d_prime_ci95;
    /// c; for two alternatives the preference for right over left, on the scale of z.
    double criterion = 0;
    std::pair<double, double> criterion_ci95;
    /// Empty, or why there are no numbers: "no lines shown".
    std::string reason;
};

/// Throws InputError for counts that can't be.
Sensitivity sensitivity(const ResponseCounts& counts, Task task);

/// Counts of trials; those that are no evidence are left out.
ResponseCounts response_counts(const std::vector<Trial>& trials);

/// One row an observer, task and condition in the order of first trials, and one a task over all of it.
struct SensitivityRow {
    /// Empty for all observers and conditions together.
    std::string observer;
    Condition condition;
    Task task = Task::yes_no;
    bool is_total = false;
    Sensitivity sensitivity;
};

/// Totals pool counts over observers and conditions of different difficulty: that describes the study (is anybody guessing, is
/// there a preference), and is below the mean of the rows' d′ where these differ.
std::vector<SensitivityRow> sensitivity_table(const std::vector<Trial>& trials);

}  // namespace stairstep
