// Simulated observers with thresholds of their own. What is planted here, nothing downstream knows.
//
// An observer's true law is r = c·a, with ln c = ln(population slope) + an effect of the observer, part of which
// holds for all conditions and part for one pattern × contrast. An answer is correct with probability Ψ(log10(a/r)) at
// T = −log10 c, on artifact and line trials alike (an observer without response bias), lapses included.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <utility>

#include "stimuli/random.h"
#include "study/observer.h"
#include "study/psychometric.h"

namespace stairstep {

struct SimulatedPopulation {
    /// Median true slope c for the step at full contrast, > 0.
    double step_slope = 3.47;
    /// The stair's slope as a share of the step's (Kreuzer 2017: 2.5 against 3.47).
    double stair_share = 2.5 / 3.47;
    /// A contrast of 50 % lowers the slope by this share; contrasts between 0.5 and 1 in proportion.
    double half_contrast_loss = 0.04;
    /// SD of ln c between observers, ≥ 0, and the share of its variance that all conditions have in common.
    double between_observer_sd = 0.16;
    double common_share = 0.75;
    /// The observers' own psychometric function; p_threshold says what their slope means.
    PsychometricShape shape{.beta = 3.5, .gamma = 0.5, .delta = 0.02, .p_threshold = 0.82};
};

/// Throws InputError naming a field that is out of its range.
void require_valid(const SimulatedPopulation& population);

/// The population's median slope for a pattern and contrast.
double median_slope(const SimulatedPopulation& population, Pattern pattern, double contrast);

nlohmann::ordered_json to_json(const SimulatedPopulation& population);

/// One member of the population. Same population and random stream, same answers.
class SimulatedObserver {
  public:
    /// `start_s`: when the session begins, Unix time, s; a simulated clock runs from there.
    SimulatedObserver(const SimulatedPopulation& population, Random random, double start_s);

    Answer operator()(const Presentation& presentation);

    /// The observer's own c for a pattern and contrast, drawn when first asked for.
    double true_slope(Pattern pattern, double contrast);

  private:
    SimulatedPopulation population_;
    Random traits_;
    Random answers_;
    double common_effect_;
    double offset_;
    double clock_s_;
    std::map<std::pair<Pattern, double>, double> slopes_;
};

}  // namespace stairstep
