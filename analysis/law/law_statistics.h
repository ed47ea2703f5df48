// What stands behind a law's slope: every estimate with the method that made it, in words, and how much hangs on one observer,
// one size or one method. Part of law.json; a program that only needs the law can ignore all of it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stimuli/edge.h"
#include "stimuli/kernel.h"

namespace stairstep {

/// A 95 % interval, low to high.
using Interval = std::pair<double, double>;

struct SlopeEstimate {
    /// Short, as on the command line: "knapp-hartung".
    std::string name;
    double value = 0;
    Interval ci95;
    /// How value and interval were made, in words.
    std::string method;
};

/// One observer's slope in one condition.
struct ObserverSlope {
    std::string observer;
    /// ln c and the standard error that the thresholds' own uncertainty gives it.
    double ln_slope = 0;
    double ln_slope_se = 0;
    /// c by weighted least squares of r = c·a in pixels.
    double linear_slope = 0;
    /// Share of the weight in the condition's mean; over observers they sum to 1.
    double weight = 0;
    int trials = 0;
};

/// The slope without one observer or one texel size.
struct LeftOut {
    /// The observer, or the size in px.
    std::string left_out;
    double slope = 0;
    /// slope over the slope of all, less 1.
    double change = 0;
    /// Whether nothing else that was left out moves the slope further.
    bool is_largest = false;
};

/// What a robust fit trusts less than the rest.
struct DownWeighted {
    std::string observer;
    /// Of one threshold; none where it is the observer as a whole.
    std::optional<double> texel_px;
    /// In (0, 1): its weight as a share of what a plain fit gives it.
    double weight = 1;
};

struct ConditionName {
    Pattern pattern = Pattern::step;
    double contrast = 1;
    KernelShape kernel = KernelShape::box;
};

/// Two conditions, on the observers who have both.
struct Comparison {
    ConditionName first;
    ConditionName second;
    /// Slope of the first over the second: exp of the mean difference of ln c.
    double ratio = 1;
    Interval ratio_ci95;
    /// Of a paired t test that the ratio is 1, and adjusted for all comparisons by Holm's method.
    double p = 1;
    double p_holm = 1;
    int observers = 0;
    std::string method;
};

/// The worst-case slope where thresholds are defined by another share of right answers.
struct CriterionLaw {
    double threshold_probability = 0.82;
    double slope = 0;
    Interval slope_ci95;
    ConditionName worst;
    /// Texels that the law asks for over those at p = .82: along an axis slope/slope_82, in all its square.
    double texels_across = 1;
    double texels_in_all = 1;
};

nlohmann::ordered_json to_json(const SlopeEstimate& estimate);
nlohmann::ordered_json to_json(const ObserverSlope& slope);
/// `key` names what was left out: "observer" or "texel_px".
nlohmann::ordered_json to_json(const LeftOut& left_out, const std::string& key);
nlohmann::ordered_json to_json(const DownWeighted& weight);
nlohmann::ordered_json to_json(const ConditionName& condition);
nlohmann::ordered_json to_json(const Comparison& comparison);
nlohmann::ordered_json to_json(const CriterionLaw& criterion);

/// "step at 50 % contrast"; with the kernel where `with_kernel`.
std::string describe(const ConditionName& condition, bool with_kernel = false);

}  // namespace stairstep
