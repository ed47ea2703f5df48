#include "analysis/power.h"

#include <atomic>
#include <cmath>

#include "analysis/statistics.h"
#include "stimuli/error.h"
#include "stimuli/number.h"
#include "stimuli/parallel.h"

namespace stairstep {
namespace {

/// Presentations come about every two seconds (Kreuzer 2017: 25 minutes an observer).
constexpr double kSeconds_per_trial = 2.3;

std::string list_of(const std::vector<double>& values) {
    std::string text;
    for (size_t i = 0; i < values.size(); ++i) {
        if (i > 0) text += i + 1 == values.size() ? " and " : ", ";
        text += format_number(values[i]);
    }
    return text;
}

PlantedStudy planted(const StudyPlan& plan, const PlannedEffect& effect, const SimulatedPopulation& population) {
    PlantedStudy study{plan.observers, {}, population};
    study.design.patterns = {Pattern::step};
    study.design.texels_px = plan.texels_px;
    study.design.stop = {std::min(10, plan.trials_a_track), plan.trials_a_track, {}};
    if (effect.kind == PlannedEffect::Kind::slope_ratio) {
        study.design.contrasts = {1, 0.5};
        study.population.half_contrast_loss = 1 - effect.value;
    } else {
        study.design.contrasts = {1};
        study.population.exponent = effect.value;
    }
    return study;
}

bool finds(const PlannedEffect& effect, const Law& law) {
    if (effect.kind == PlannedEffect::Kind::slope_ratio) {
        return law.comparisons.size() == 1 && law.comparisons[0].p < 0.05;
    }
    const ConditionLaw& condition = law.conditions[0];
    return condition.has_form && (condition.exponent_ci95.first > 1 || condition.exponent_ci95.second < 1);
}

}  // namespace

PlannedEffect parse_effect(const std::string& text) {
    const size_t equals = text.find('=');
    const std::string kind = text.substr(0, equals);
    const bool is_ratio = kind == "slope-ratio";
    const double value = equals == std::string::npos ? 0 : parse_number(text.substr(equals + 1)).value_or(0);
    if ((!is_ratio && kind != "exponent") || value < 0.5 || value > 2) {
        throw InputError("--effect", "\"" + text + "\" is no effect",
                         "write slope-ratio=0.9 or exponent=0.8, values from 0.5 to 2");
    }
    return {is_ratio ? PlannedEffect::Kind::slope_ratio : PlannedEffect::Kind::exponent, value};
}

int StudyPlan::conditions(const PlannedEffect& effect) const {
    return effect.kind == PlannedEffect::Kind::slope_ratio ? 2 : 1;
}

int StudyPlan::trials_an_observer(const PlannedEffect& effect) const {
    return conditions(effect) * static_cast<int>(texels_px.size()) * trials_a_track;
}

Interval Power::ci95() const {
    const double n = studies;
    const double z = normal_quantile(0.975);
    const double z2 = z * z;
    const double middle = (power() + z2 / (2 * n)) / (1 + z2 / n);
    const double half = std::sqrt(z2 * (power() * (1 - power()) / n + z2 / (4 * n * n))) / (1 + z2 / n);
    return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

Power power_of(const StudyPlan& plan, const PlannedEffect& effect, const SimulatedPopulation& population,
               const CoverageSettings& settings, const std::function<void()>& done) {
    const PlantedStudy study = planted(plan, effect, population);
    std::atomic<int> found = 0;
    run_in_parallel(static_cast<size_t>(settings.studies), settings.jobs, [&](size_t i) {
        const uint64_t seed = Random(settings.seed).stream(i).bits() >> 1;
        try {
            found += finds(effect, fit_law(simulate_study(study, seed), settings.p_threshold, "simulated").law);
        } catch (const FailureError&) {
            // No law, nothing found.
        }
        done();
    });
    return {plan, settings.studies, found};
}

std::string sentence(const Power& power, const PlannedEffect& effect, const SimulatedPopulation& population,
                     const CoverageSettings& settings) {
    const StudyPlan& plan = power.plan;
    const bool is_ratio = effect.kind == PlannedEffect::Kind::slope_ratio;
    const int trials = plan.trials_an_observer(effect);
    const Interval ci = power.ci95();
    return "With " + std::to_string(plan.observers) + " observers, each giving " + std::to_string(plan.trials_a_track) +
           " trials at each of " + std::to_string(plan.texels_px.size()) + " texel sizes (" + list_of(plan.texels_px) +
           " px)" + (is_ratio ? " at full and at half contrast" : "") + " (" + std::to_string(trials) +
           " trials, about " + format_fixed(trials * kSeconds_per_trial / 60, 0) + " minutes an observer), " +
           (is_ratio ? "a paired t test of the log slopes (two-sided, 5 %) finds a ratio of slopes of "
                     : "the 95 % interval of the exponent in r = c a^p leaves out 1 where the exponent is ") +
           format_number(effect.value) + " with probability " + format_fixed(power.power(), 2) + " (95 % interval " +
           format_fixed(ci.first, 2) + " to " + format_fixed(ci.second, 2) + ", " + std::to_string(power.studies) +
           " simulated studies, seed " + std::to_string(settings.seed) + ", thresholds at " +
           format_number(settings.p_threshold) + "; simulated observers: SD of ln c " +
           format_number(population.between_observer_sd) + " of whose variance " +
           format_number(population.common_share) + " is common to conditions, steepness " +
           format_number(population.shape.beta) + ", lapse rate " + format_number(population.shape.delta) +
           ", deviation of single thresholds " + format_number(population.deviation_sd) + "; Stairstep " +
           STAIRSTEP_VERSION + ").";
}

}  // namespace stairstep
