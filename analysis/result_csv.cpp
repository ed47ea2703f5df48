#include "analysis/result_csv.h"

#include <cmath>

#include "stimuli/io/csv.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

std::string number_or_nothing(const std::optional<double>& value) {
    return value ? format_number(*value) : "";
}

std::vector<std::string> condition_fields(const ConditionName& c) {
    return {std::string(name(c.pattern)), format_number(c.contrast), std::string(name(c.kernel))};
}

std::vector<std::string> operator+(std::vector<std::string> row, const std::vector<std::string>& more) {
    row.insert(row.end(), more.begin(), more.end());
    return row;
}

}  // namespace

std::string thresholds_csv(const LawFit& fit) {
    CsvWriter csv;
    csv.row({"observer", "pattern", "contrast", "kernel", "texel_px", "radius_px", "radius_low_px", "radius_high_px",
             "trials", "bounded"});
    for (const Threshold& t : fit.thresholds) {
        const auto radius = [&t](double log_threshold) {
            return format_number(t.condition.texel_px * std::pow(10.0, -log_threshold));
        };
        // A high T is a small radius.
        csv.row({t.observer, std::string(name(t.condition.pattern)), format_number(t.condition.contrast),
                 std::string(name(t.condition.kernel)), format_number(t.condition.texel_px), radius(t.log_threshold),
                 radius(t.log_threshold_ci95.second), radius(t.log_threshold_ci95.first), std::to_string(t.trials),
                 t.bounded ? "1" : "0"});
    }
    return csv.text();
}

std::string law_csv(const Law& law) {
    CsvWriter csv;
    csv.row({"pattern", "contrast", "kernel", "slope", "slope_low", "slope_high", "tau_ln", "intercept_px",
             "intercept_low_px", "intercept_high_px", "exponent", "exponent_low", "exponent_high", "observers",
             "trials"});
    for (const ConditionLaw& c : law.conditions) {
        const auto form = [&c](double value) { return c.has_form ? format_number(value) : std::string(); };
        csv.row({std::string(name(c.pattern)), format_number(c.contrast), std::string(name(c.kernel)),
                 format_number(c.slope), format_number(c.slope_ci95.first), format_number(c.slope_ci95.second),
                 format_number(c.tau_ln), form(c.intercept_px), form(c.intercept_ci95.first),
                 form(c.intercept_ci95.second), form(c.exponent), form(c.exponent_ci95.first),
                 form(c.exponent_ci95.second), std::to_string(c.observers), std::to_string(c.trials)});
    }
    return csv.text();
}

std::string reference_points_csv(const std::vector<ReferencePoint>& points) {
    CsvWriter csv;
    csv.row({"pattern", "contrast", "kernel", "texel_px", "reference_radius_px"});
    for (const ReferencePoint& p : points) {
        csv.row(condition_fields(p.condition) + std::vector{format_number(p.texel_px), number_or_nothing(p.radius_px)});
    }
    return csv.text();
}

std::string sensitivity_csv(const std::vector<Trial>& trials) {
    CsvWriter csv;
    csv.row({"observer", "pattern", "contrast", "kernel", "texel_px", "task", "artifacts", "hits", "lines",
             "false_alarms", "d_prime", "d_prime_low", "d_prime_high", "criterion", "criterion_low", "criterion_high"});
    for (const SensitivityRow& row : sensitivity_table(trials)) {
        const Condition& c = row.condition;
        std::vector<std::string> fields{row.observer};
        fields = fields + (row.is_total ? std::vector<std::string>(4)
                                        : condition_fields({c.pattern, c.contrast, c.kernel}) +
                                              std::vector{format_number(c.texel_px)});
        const Sensitivity& s = row.sensitivity;
        fields = fields + std::vector{std::string(name(row.task)), std::to_string(s.counts.artifacts),
                                      std::to_string(s.counts.hits), std::to_string(s.counts.lines),
                                      std::to_string(s.counts.false_alarms)};
        csv.row(fields +
                (s.reason.empty()
                     ? std::vector{format_number(s.d_prime), format_number(s.d_prime_ci95.first),
                                   format_number(s.d_prime_ci95.second), format_number(s.criterion),
                                   format_number(s.criterion_ci95.first), format_number(s.criterion_ci95.second)}
                     : std::vector<std::string>(6)));
    }
    return csv.text();
}

std::string checks_csv(const StudyCheck& check) {
    CsvWriter csv;
    csv.row({"pattern", "contrast", "kernel", "curves", "steepness", "lapse", "lapse_low", "lapse_high", "deviance_p",
             "prediction_p", "order_p", "scatter_chi2", "scatter_df", "scatter_p", "overdispersion"});
    for (const ConditionCheck& c : check.conditions) {
        const bool has_shape = c.aligned && c.aligned->estimated;
        const auto lapse = has_shape ? lapse_interval(*c.aligned) : std::nullopt;
        csv.row(condition_fields(c.condition) +
                std::vector{std::to_string(c.curves), has_shape ? format_number(c.aligned->parameters.slope) : "",
                            has_shape ? format_number(c.aligned->parameters.lapse) : "",
                            lapse ? format_number(lapse->first) : "", lapse ? format_number(lapse->second) : "",
                            number_or_nothing(c.deviance_p), number_or_nothing(c.prediction_p),
                            number_or_nothing(c.order_p), format_number(c.scatter_chi2), std::to_string(c.scatter_df),
                            number_or_nothing(c.scatter_p), number_or_nothing(c.overdispersion)});
    }
    return csv.text();
}

std::string comparisons_csv(const Law& law) {
    CsvWriter csv;
    csv.row({"first_pattern", "first_contrast", "second_pattern", "second_contrast", "kernel", "ratio", "ratio_low",
             "ratio_high", "p", "p_holm", "observers"});
    for (const Comparison& c : law.comparisons) {
        csv.row({std::string(name(c.first.pattern)), format_number(c.first.contrast),
                 std::string(name(c.second.pattern)), format_number(c.second.contrast),
                 std::string(name(c.first.kernel)), format_number(c.ratio), format_number(c.ratio_ci95.first),
                 format_number(c.ratio_ci95.second), format_number(c.p), format_number(c.p_holm),
                 std::to_string(c.observers)});
    }
    return csv.text();
}

std::string criteria_csv(const Law& law) {
    CsvWriter csv;
    csv.row({"threshold_probability", "slope", "slope_low", "slope_high", "texels_across", "texels_in_all"});
    for (const CriterionLaw& c : law.criteria) {
        csv.row({format_number(c.threshold_probability), format_number(c.slope), format_number(c.slope_ci95.first),
                 format_number(c.slope_ci95.second), format_number(c.texels_across), format_number(c.texels_in_all)});
    }
    return csv.text();
}

std::string estimates_csv(const Law& law, const Law& robust) {
    CsvWriter csv;
    csv.row({"pattern", "contrast", "kernel", "method", "slope", "slope_low", "slope_high"});
    const auto add = [&](const ConditionLaw& c, const std::string& method, double slope, const Interval& interval) {
        csv.row(condition_fields({c.pattern, c.contrast, c.kernel}) + std::vector{method, format_number(slope),
                                                                                  format_number(interval.first),
                                                                                  format_number(interval.second)});
    };
    for (const ConditionLaw& c : law.conditions) {
        for (const SlopeEstimate& e : c.estimates) add(c, e.name, e.value, e.ci95);
    }
    for (const ConditionLaw& c : robust.conditions) add(c, "robust", c.slope, c.slope_ci95);
    return csv.text();
}

}  // namespace stairstep
