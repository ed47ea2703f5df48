// How large a study must be to find an effect: the share of simulated studies that find it.
//
// Two effects. A slope ratio, c of one contrast over c of full contrast for the same observers: found where the paired t test
// says p < .05. An exponent p of r = c·a^p other than 1: found where its 95 % interval leaves 1 out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/coverage.h"

namespace stairstep {

/// What is planted, and looked for.
struct PlannedEffect {
    enum class Kind { slope_ratio, exponent };
    Kind kind = Kind::slope_ratio;
    /// The ratio, or the exponent; 0.5 to 2 and other than 1 for power proper. 1 counts false alarms.
    double value = 0.9;
};

/// "slope-ratio=0.9" or "exponent=0.8"; throws InputError for anything else.
PlannedEffect parse_effect(const std::string& text);

/// A study that might be run.
struct StudyPlan {
    int observers = 10;
    int trials_a_track = 40;
    std::vector<double> texels_px{5, 10, 20, 30};

    int conditions(const PlannedEffect& effect) const;
    /// Of one observer, all conditions together.
    int trials_an_observer(const PlannedEffect& effect) const;
};

struct Power {
    StudyPlan plan;
    /// Studies simulated; those that could not be fitted found nothing.
    int studies = 0;
    int found = 0;

    double power() const { return static_cast<double>(found) / studies; }
    /// Wilson's 95 % interval.
    Interval ci95() const;
};

/// `population` says how observers differ; what the effect plants replaces its own.
Power power_of(
    const StudyPlan& plan, const PlannedEffect& effect, const SimulatedPopulation& population,
    const CoverageSettings& settings, const std::function<void()>& done = [] {});

/// One sentence for a preregistration: what was simulated, how, and with which power the effect is found.
std::string sentence(const Power& power, const PlannedEffect& effect, const SimulatedPopulation& population,
                     const CoverageSettings& settings);

}  // namespace stairstep
