// What every engine says of the threshold it looks for, and what makes a type an engine.
//
// An engine is a value: copyable, without clock, file or randomness of its own. It suggests where to put the next trial,
// takes in the answer given at the intensity that was really shown, and estimates. Intensities and thresholds are log10
// units of x = log10(texel_px/radius_px); greater is easier.
#pragma once

#include <concepts>

namespace stairstep {

struct ThresholdEstimate {
    /// T, and how sure the engine is of it: the posterior's mean and standard deviation.
    double threshold = 0;
    double sd = 0;
    /// Between these lies 95 % of the posterior, 2.5 % on either side.
    double low = 0;
    double high = 0;
};

template <typename E>
concept AdaptiveEngine = std::copyable<E> && requires(E engine, const E& known, double intensity, bool correct) {
    { known.suggest() } -> std::same_as<double>;
    { engine.update(intensity, correct) } -> std::same_as<void>;
    { known.estimate() } -> std::same_as<ThresholdEstimate>;
    { known.trials() } -> std::same_as<int>;
};

}  // namespace stairstep
