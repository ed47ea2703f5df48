#include "analysis/result_csv.h"

#include <cmath>

#include "stimuli/io/csv.h"
#include "stimuli/number.h"

namespace stairstep {

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

}  // namespace stairstep
