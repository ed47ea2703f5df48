#include "analysis/comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "analysis/statistics.h"

namespace stairstep {
namespace {

ConditionName name_of(const ConditionLaw& law) {
    return {law.pattern, law.contrast, law.kernel};
}

std::optional<Comparison> compare(const ConditionLaw& first, const ConditionLaw& second) {
    std::map<std::string, double> others;
    for (const ObserverSlope& o : second.observer_slopes) others[o.observer] = o.ln_slope;
    std::vector<double> differences;
    for (const ObserverSlope& o : first.observer_slopes) {
        if (const auto other = others.find(o.observer); other != others.end()) {
            differences.push_back(o.ln_slope - other->second);
        }
    }
    if (differences.size() < 2) return std::nullopt;
    const MeanEstimate mean = mean_with_interval(differences);
    const double n = static_cast<double>(differences.size());
    Comparison comparison;
    comparison.first = name_of(first);
    comparison.second = name_of(second);
    comparison.ratio = std::exp(mean.mean);
    comparison.ratio_ci95 = {std::exp(mean.ci95.first), std::exp(mean.ci95.second)};
    // Without any spread every difference but none is certain.
    const double t = mean.mean == 0 ? 0 : mean.mean / (mean.sd / std::sqrt(n));
    comparison.p = t_two_sided_p(t, n - 1);
    comparison.observers = static_cast<int>(differences.size());
    comparison.method = "mean difference of ln c over observers with both, Student's t; p adjusted by Holm's method";
    return comparison;
}

}  // namespace

std::vector<Comparison> paired_comparisons(const std::vector<ConditionLaw>& conditions,
                                           std::vector<std::string>& warnings) {
    std::vector<Comparison> comparisons;
    const auto add = [&](const ConditionLaw& first, const ConditionLaw& second) {
        if (const auto comparison = compare(first, second)) {
            comparisons.push_back(*comparison);
        } else {
            warnings.push_back(describe(name_of(first)) + " and " + describe(name_of(second)) +
                               " not compared: fewer than two observers have both");
        }
    };
    for (const ConditionLaw& first : conditions) {
        double full_contrast = 0;
        for (const ConditionLaw& other : conditions) {
            if (other.pattern == first.pattern && other.kernel == first.kernel) {
                full_contrast = std::max(full_contrast, other.contrast);
            }
        }
        for (const ConditionLaw& second : conditions) {
            if (first.kernel != second.kernel) continue;
            const bool patterns =
                first.pattern == Pattern::step && second.pattern == Pattern::stair && first.contrast == second.contrast;
            const bool contrasts =
                first.pattern == second.pattern && first.contrast == full_contrast && second.contrast < full_contrast;
            if (patterns || contrasts) add(first, second);
        }
    }
    std::vector<double> p_values;
    for (const Comparison& c : comparisons) p_values.push_back(c.p);
    const std::vector<double> adjusted = holm_adjusted(p_values);
    for (size_t i = 0; i < comparisons.size(); ++i) comparisons[i].p_holm = adjusted[i];
    return comparisons;
}

}  // namespace stairstep
