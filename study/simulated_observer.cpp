#include "study/simulated_observer.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {

void require_valid(const SimulatedPopulation& p) {
    const auto require = [](bool holds, const char* flag, double value, const char* problem, const char* remedy) {
        if (!holds) throw InputError(std::string(flag) + " " + format_number(value), problem, remedy);
    };
    require(p.step_slope > 0 && std::isfinite(p.step_slope), "law slope", p.step_slope,
            "must be a finite number above 0", "use for example 3.47");
    require(p.between_observer_sd >= 0 && p.between_observer_sd <= 2, "between-observer SD", p.between_observer_sd,
            "must lie in 0 to 2 (of ln c)", "use for example 0.16");
    require(is_valid(p.shape), "lapse rate", p.shape.delta, "leaves no threshold at the probability asked for",
            "use for example 0.02");
}

double median_slope(const SimulatedPopulation& population, Pattern pattern, double contrast) {
    const double pattern_slope = population.step_slope * (pattern == Pattern::stair ? population.stair_share : 1);
    return pattern_slope * (1 - population.half_contrast_loss * (1 - contrast) / 0.5);
}

nlohmann::ordered_json to_json(const SimulatedPopulation& p) {
    return {{"step_slope", p.step_slope},
            {"stair_share", p.stair_share},
            {"half_contrast_loss", p.half_contrast_loss},
            {"between_observer_sd", p.between_observer_sd},
            {"common_share", p.common_share},
            {"beta", p.shape.beta},
            {"gamma", p.shape.gamma},
            {"delta", p.shape.delta},
            {"p_threshold", p.shape.p_threshold}};
}

SimulatedObserver::SimulatedObserver(const SimulatedPopulation& population, Random random, double start_s)
    : population_(population),
      traits_(random.stream(1)),
      answers_(random.stream(2)),
      common_effect_(traits_.normal()),
      offset_(threshold_offset(population.shape)),
      clock_s_(start_s) {}

double SimulatedObserver::true_slope(Pattern pattern, double contrast) {
    const auto [entry, is_new] = slopes_.try_emplace({pattern, contrast});
    if (is_new) {
        // A stream of its own for each condition: the slope doesn't depend on the order of the rounds.
        Random random = traits_.stream(static_cast<uint64_t>(pattern) * 1'000'000 + std::llround(contrast * 1000));
        const double effect = std::sqrt(population_.common_share) * common_effect_ +
                              std::sqrt(1 - population_.common_share) * random.normal();
        entry->second =
            median_slope(population_, pattern, contrast) * std::exp(population_.between_observer_sd * effect);
    }
    return entry->second;
}

Answer SimulatedObserver::operator()(const Presentation& shown) {
    const double threshold = -std::log10(true_slope(shown.condition.pattern, shown.condition.contrast));
    const double strength = std::log10(shown.condition.texel_px / shown.radius_px);
    const bool correct = answers_.uniform() < probability_correct(population_.shape, offset_, strength, threshold);
    const Judgement other = shown.stimulus == Judgement::artifact ? Judgement::line : Judgement::artifact;

    Answer answer;
    answer.response = correct ? shown.stimulus : other;
    answer.response_time_s = 0.3 + 1.2 * std::exp(0.4 * answers_.normal());
    answer.shown_at_s = clock_s_;
    clock_s_ += answer.response_time_s + 0.5;
    return answer;
}

}  // namespace stairstep
