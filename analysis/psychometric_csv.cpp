// The data of psychometric_figure.h as tables.
#include <cmath>

#include "analysis/binomial_interval.h"
#include "analysis/psychometric_figure.h"
#include "stimuli/io/csv.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

std::vector<std::string> condition_fields(const ConditionName& c) {
    return {std::string(name(c.pattern)), format_number(c.contrast), std::string(name(c.kernel))};
}

void append(std::vector<std::string>& row, const std::vector<std::string>& fields) {
    row.insert(row.end(), fields.begin(), fields.end());
}

void add_bins(CsvWriter& csv, const ConditionName& condition, const std::string& observer, bool aligned,
              const std::vector<ResponseBin>& bins, const PsychometricFit* fit) {
    for (const ResponseBin& bin : bins) {
        const auto [low, high] = binomial_interval(bin.right, bin.trials);
        std::vector<std::string> row = condition_fields(condition);
        append(row, {observer, aligned ? "1" : "0", format_number(bin.strength), std::to_string(bin.trials),
                     std::to_string(bin.right), format_number(low), format_number(high),
                     std::to_string(bin.counts.artifacts), std::to_string(bin.counts.hits),
                     std::to_string(bin.counts.lines), std::to_string(bin.counts.false_alarms),
                     fit != nullptr && fit->estimated ? format_number(fit->probability(bin.strength)) : ""});
        csv.row(row);
    }
}

std::string finite_or_nothing(double value) {
    return std::isfinite(value) ? format_number(value) : "";
}

}  // namespace

std::string psychometric_csv(const StudyCheck& check) {
    CsvWriter csv;
    csv.row({"pattern", "contrast", "kernel", "observer", "aligned", "strength", "trials", "right", "right_low",
             "right_high", "artifacts", "hits", "lines", "false_alarms", "fitted"});
    for (const ConditionCheck& c : check.conditions) {
        add_bins(csv, c.condition, "", true, pooled_bins(check, c.condition), c.aligned ? &*c.aligned : nullptr);
    }
    for (const ObserverCurve& curve : check.curves) {
        add_bins(csv, curve.condition, curve.observer, false, observer_bins(curve), &curve.fit);
    }
    return csv.text();
}

std::string psychometric_fits_csv(const StudyCheck& check) {
    CsvWriter csv;
    csv.row({"observer",
             "pattern",
             "contrast",
             "kernel",
             "trials",
             "right",
             "threshold",
             "threshold_px_per_texel",
             "threshold_low",
             "threshold_high",
             "steepness",
             "lapse",
             "lapse_low",
             "lapse_high",
             "deviance",
             "deviance_p",
             "residual_with_prediction",
             "residual_with_prediction_p",
             "residual_with_order",
             "residual_with_order_p",
             "influential_trials",
             "remark"});
    for (const ObserverCurve& curve : check.curves) {
        int right = 0;
        for (const Answer01& answer : curve.answers) right += answer.correct;
        std::vector<std::string> row{curve.observer};
        append(row, condition_fields(curve.condition));
        append(row, {std::to_string(curve.answers.size()), std::to_string(right)});
        const PsychometricFit& fit = curve.fit;
        if (fit.estimated) {
            const auto lapse = lapse_interval(fit);
            append(row,
                   {format_number(fit.parameters.threshold), format_number(std::pow(10.0, -fit.parameters.threshold)),
                    finite_or_nothing(fit.threshold_ci95.first), finite_or_nothing(fit.threshold_ci95.second),
                    format_number(fit.parameters.slope), format_number(fit.parameters.lapse),
                    lapse ? format_number(lapse->first) : "", lapse ? format_number(lapse->second) : "",
                    format_number(fit.deviance)});
        } else {
            append(row, std::vector<std::string>(9));
        }
        if (curve.goodness) {
            const GoodnessOfFit& g = *curve.goodness;
            append(row,
                   {format_number(g.deviance.p_value), format_number(g.residual_with_prediction.observed),
                    format_number(g.residual_with_prediction.p_value), format_number(g.residual_with_order.observed),
                    format_number(g.residual_with_order.p_value), std::to_string(g.influential.size())});
        } else {
            append(row, std::vector<std::string>(6));
        }
        append(row, {fit.reason});
        csv.row(row);
    }
    return csv.text();
}

}  // namespace stairstep
