// One condition between its thresholds and its law: what law_fit.h does for each pattern, contrast and kernel.
//
// Each observer's law (observer_fit.h), the slope over observers by every method (slope_estimate.h), intercept and exponent as
// random-effects means, how far one observer or one size moves the slope, and warnings where weights make its interval doubtful.
//
// Anchor: with equal errors the mean without observer j is (n·m − y_j)/(n − 1).
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "analysis/law/law_file.h"
#include "analysis/observer_fit.h"
#include "analysis/slope_estimate.h"
#include "analysis/threshold_fit.h"

namespace stairstep {

/// A law has one pattern, contrast and kernel.
struct ConditionKey {
    Pattern pattern;
    double contrast;
    KernelShape kernel;

    /// By pattern, then from full contrast down.
    bool operator<(const ConditionKey& other) const {
        return std::tuple(pattern, -contrast, kernel) < std::tuple(other.pattern, -other.contrast, other.kernel);
    }
};

/// "step, contrast 1, box".
std::string text_of(const ConditionKey& key);

using ThresholdsByObserver = std::map<std::string, std::vector<Threshold>>;

struct FittedCondition {
    ConditionKey key;
    /// In the order of data.observers.
    std::vector<ObserverLaw> laws;
    SlopeData data;
};

/// Why the interval of `estimate`, made by `method`, may hold the slope less often than it says, for people; empty where nothing
/// is known against it (docs/coverage.md). `weights` are the observers' in the random-effects mean, and sum to 1.
std::string interval_warning(SlopeMethod method, const SlopeEstimate& estimate, const std::vector<double>& weights);

/// Each observer's law. Who could not be fitted is left out and named in `warnings`.
FittedCondition fit_observers(const ConditionKey& key, const ThresholdsByObserver& observers, bool robust,
                              std::vector<std::string>& warnings);

/// The law of a condition with two observers or more; slope and interval are those of `method`. Without replicates `estimates` has
/// only what needs none.
ConditionLaw law_of(const FittedCondition& condition, SlopeMethod method, const BootstrapSettings& bootstrap,
                    std::vector<std::string>& warnings);

}  // namespace stairstep
