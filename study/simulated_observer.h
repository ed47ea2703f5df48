// Simulated observers with thresholds of their own. What is planted here, nothing downstream knows.
//
// An observer's true law is r = c·a (or with an exponent, or deviations from it, to see whether they are found), with ln c = ln(population slope) + an effect of the observer, part of which
// holds for all conditions and part for one pattern × contrast. An answer is correct with probability Ψ(log10(a/r)) at
// T = −log10 c, lapses included. Where nothing was seen the observer guesses, with or without a preference, and over a
// session the threshold may drift and attention tire: what an engine's model of an observer leaves out.
#pragma once

#include <nlohmann/json_fwd.hpp>

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
    /// p of r = c·10 px·(a/10 px)^p: 1 is the law; c is then the slope at 10 px. In [0.1, 3].
    double exponent = 1;
    /// SD of ln r between an observer's texel sizes, beyond the law; in [0, 2].
    double deviation_sd = 0;
    /// SD of ln c between observers, ≥ 0, and the share of its variance that all conditions have in common.
    double between_observer_sd = 0.16;
    double common_share = 0.75;
    /// The observers' own psychometric function; p_threshold says what their slope means. γ is ½: two answers, one right.
    PsychometricShape shape{.beta = 3.5, .gamma = 0.5, .delta = 0.02, .p_threshold = 0.82};
    /// Who sees nothing says "artifact" with probability ½ + bias; in [−½, ½].
    double response_bias = 0;
    /// log10 units by which T rises (the task becomes harder) every hundred presentations.
    double drift = 0;
    /// How much the lapse rate grows every hundred presentations without a break, ≥ 0; it stays below ½.
    double fatigue = 0;
    /// Share of answers that the observer takes back at once, [0, 0.5].
    double redo_share = 0;
};

/// Throws InputError naming a field that is out of its range.
void require_valid(const SimulatedPopulation& population);

/// The population's median slope for a pattern and contrast.
double median_slope(const SimulatedPopulation& population, Pattern pattern, double contrast);

nlohmann::ordered_json to_json(const SimulatedPopulation& population);

/// One member of the population. The answer to the n-th presentation depends on the population, the random stream, n and what
/// is shown, not on the calls before: a session that is resumed gets the answers it would have got.
class SimulatedObserver {
  public:
    /// `start_s`: when the session begins, Unix time, s; a simulated clock runs from there.
    SimulatedObserver(const SimulatedPopulation& population, Random random, double start_s);

    Answer operator()(const Presentation& presentation) const;

    /// The observer's own c for a pattern and contrast.
    double true_slope(Pattern pattern, double contrast) const;

    /// The observer's own radius at threshold, in texels: c where the law holds.
    double true_radius_texels(const Condition& condition) const;

  private:
    SimulatedPopulation population_;
    Random traits_;
    Random answers_;
    double common_effect_;
    double offset_;
    double start_s_;
};

}  // namespace stairstep
