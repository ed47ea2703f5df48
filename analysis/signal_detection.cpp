#include "analysis/signal_detection.h"

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "analysis/statistics.h"
#include "stimuli/error.h"

namespace stairstep {
namespace {

/// Corrected rate, its z, and the variance of z.
struct Rate {
    double rate, z, variance;

    Rate(int count, int trials) {
        const boost::math::normal normal;
        rate = (count + 0.5) / (trials + 1.0);
        z = boost::math::quantile(normal, rate);
        variance = rate * (1 - rate) / (trials * std::pow(boost::math::pdf(normal, z), 2));
    }
};

std::pair<double, double> interval(double value, double variance) {
    const double half = normal_quantile(0.975) * std::sqrt(variance);
    return {value - half, value + half};
}

}  // namespace

Sensitivity sensitivity(const ResponseCounts& counts, Task task) {
    if (counts.hits < 0 || counts.false_alarms < 0 || counts.hits > counts.artifacts ||
        counts.false_alarms > counts.lines) {
        throw InputError("response counts", "more answers than trials, or fewer than none", "count again");
    }
    Sensitivity result;
    result.counts = counts;
    if (counts.artifacts == 0 || counts.lines == 0) {
        const bool sides = task == Task::two_alternative;
        result.reason = counts.artifacts == 0 ? (sides ? "no artifacts on the left" : "no artifacts shown")
                                              : (sides ? "no artifacts on the right" : "no lines shown");
        return result;
    }
    const Rate hit(counts.hits, counts.artifacts);
    const Rate false_alarm(counts.false_alarms, counts.lines);
    const double variance = hit.variance + false_alarm.variance;
    const double scale = task == Task::two_alternative ? 1 / std::numbers::sqrt2 : 1;
    result.hit_rate = hit.rate;
    result.false_alarm_rate = false_alarm.rate;
    result.d_prime = scale * (hit.z - false_alarm.z);
    result.d_prime_ci95 = interval(result.d_prime, scale * scale * variance);
    result.criterion = -(hit.z + false_alarm.z) / 2;
    result.criterion_ci95 = interval(result.criterion, variance / 4);
    return result;
}

ResponseCounts response_counts(const std::vector<Trial>& trials) {
    ResponseCounts counts;
    for (const Trial& trial : trials) {
        if (!trial.is_evidence()) continue;
        const bool said_artifact = trial.response == Judgement::artifact;
        if (trial.stimulus == Judgement::artifact) {
            ++counts.artifacts;
            counts.hits += said_artifact;
        } else {
            ++counts.lines;
            counts.false_alarms += said_artifact;
        }
    }
    return counts;
}

std::vector<SensitivityRow> sensitivity_table(const std::vector<Trial>& trials) {
    std::vector<SensitivityRow> rows;
    std::vector<std::vector<Trial>> trials_of;
    std::map<std::tuple<Task, std::string, Pattern, KernelShape, double, double>, size_t> index;
    std::map<Task, std::vector<Trial>> totals;
    for (const Trial& trial : trials) {
        if (!trial.is_evidence()) continue;
        const Condition& c = trial.condition;
        const auto [place, is_new] =
            index.try_emplace({trial.task, trial.observer, c.pattern, c.kernel, c.contrast, c.texel_px}, rows.size());
        if (is_new) {
            rows.push_back({trial.observer, c, trial.task, false, {}});
            trials_of.emplace_back();
        }
        trials_of[place->second].push_back(trial);
        totals[trial.task].push_back(trial);
    }
    for (size_t i = 0; i < rows.size(); ++i) {
        rows[i].sensitivity = sensitivity(response_counts(trials_of[i]), rows[i].task);
    }
    for (const auto& [task, all] : totals) {
        rows.push_back({"", {}, task, true, sensitivity(response_counts(all), task)});
    }
    return rows;
}

}  // namespace stairstep
