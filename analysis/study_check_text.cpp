// What study_check found, as JSON and as a table for a terminal.
#include <nlohmann/json.hpp>

#include "analysis/law_table.h"
#include "analysis/statistics.h"
#include "analysis/study_check.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

using nlohmann::ordered_json;

ordered_json number_or_null(const std::optional<double>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json pair_or_null(const std::optional<Interval>& interval) {
    return interval ? ordered_json::array({interval->first, interval->second}) : ordered_json(nullptr);
}

/// Steepness b and lapse rate δ of a fit over aligned strengths.
void add_shape(ordered_json& json, const std::optional<PsychometricFit>& fit) {
    const bool has_shape = fit && fit->estimated;
    json["steepness"] = has_shape ? ordered_json(fit->parameters.slope) : ordered_json(nullptr);
    json["lapse"] = has_shape ? ordered_json(fit->parameters.lapse) : ordered_json(nullptr);
    json["lapse_ci95"] = has_shape ? pair_or_null(lapse_interval(*fit)) : ordered_json(nullptr);
}

std::string p_or_dash(const std::optional<double>& p) {
    return p ? p_text(*p) : "–";
}

}  // namespace

ordered_json to_json(const StudyCheck& check) {
    ordered_json conditions = ordered_json::array();
    for (const ConditionCheck& c : check.conditions) {
        ordered_json json = to_json(c.condition);
        json["curves"] = c.curves;
        json["deviance_p"] = number_or_null(c.deviance_p);
        json["residual_with_prediction_p"] = number_or_null(c.prediction_p);
        json["residual_with_order_p"] = number_or_null(c.order_p);
        json["threshold_scatter_chi2"] = c.scatter_chi2;
        json["threshold_scatter_df"] = c.scatter_df;
        json["threshold_scatter_p"] = number_or_null(c.scatter_p);
        json["overdispersion"] = number_or_null(c.overdispersion);
        add_shape(json, c.aligned);
        conditions.push_back(json);
    }
    ordered_json observers = ordered_json::array();
    for (const ObserverCheck& o : check.observers) {
        const bool has_d = o.sensitivity.reason.empty();
        ordered_json json{{"observer", o.observer}, {"task", name(o.task)}, {"trials", o.trials}, {"right", o.right}};
        json["d_prime"] = has_d ? ordered_json(o.sensitivity.d_prime) : ordered_json(nullptr);
        json["d_prime_ci95"] = has_d ? pair_or_null(o.sensitivity.d_prime_ci95) : ordered_json(nullptr);
        json["criterion"] = has_d ? ordered_json(o.sensitivity.criterion) : ordered_json(nullptr);
        json["criterion_ci95"] = has_d ? pair_or_null(o.sensitivity.criterion_ci95) : ordered_json(nullptr);
        add_shape(json, o.aligned);
        json["least_deviance_p"] = number_or_null(o.least_deviance_p);
        json["least_residual_with_order_p"] = number_or_null(o.least_order_p);
        json["influential_trials"] = o.influential_trials;
        observers.push_back(json);
    }
    return {
        {"simulations", check.simulations}, {"seed", check.seed}, {"conditions", conditions}, {"observers", observers}};
}

std::string check_table(const StudyCheck& check) {
    std::vector<std::vector<std::string>> rows{{"goodness of fit", "deviance, p", "with prediction, p", "with order, p",
                                                "thresholds' scatter", "p", "overdispersion", "lapses"}};
    for (const ConditionCheck& c : check.conditions) {
        rows.push_back({describe(c.condition), p_or_dash(c.deviance_p), p_or_dash(c.prediction_p), p_or_dash(c.order_p),
                        c.scatter_df > 0 ? format_fixed(c.scatter_chi2, 1) + " / " + std::to_string(c.scatter_df) : "–",
                        p_or_dash(c.scatter_p), c.overdispersion ? format_fixed(*c.overdispersion, 2) : "–",
                        c.aligned && c.aligned->estimated ? format_fixed(c.aligned->parameters.lapse, 3) : "–"});
    }
    std::string text = aligned_rows(rows);
    if (check.simulations > 0) {
        text += "  p of " + std::to_string(check.simulations) +
                " simulations an observer, combined by Fisher's method; scatter: chi-squared / degrees of freedom\n";
    }
    std::vector<double> d_primes, criteria;
    for (const ObserverCheck& o : check.observers) {
        if (!o.sensitivity.reason.empty()) continue;
        d_primes.push_back(o.sensitivity.d_prime);
        criteria.push_back(o.sensitivity.criterion);
    }
    const auto summary = [](const std::string& what, const std::vector<double>& values) {
        const MeanEstimate mean = mean_with_interval(values);
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        return what + " " + format_fixed(mean.mean, 2) + " [" + format_fixed(mean.ci95.first, 2) + ", " +
               format_fixed(mean.ci95.second, 2) + "] over observers, who range from " + format_fixed(*least, 2) +
               " to " + format_fixed(*most, 2);
    };
    if (d_primes.size() >= 2) {
        text += "  " + summary("d'", d_primes) + "\n  " + summary("criterion", criteria) + "\n";
    }
    return text;
}

}  // namespace stairstep
