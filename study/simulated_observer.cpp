#include "study/simulated_observer.h"

#include <algorithm>
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
    require(p.exponent >= 0.1 && p.exponent <= 3, "exponent", p.exponent, "must lie in 0.1 to 3",
            "use for example 0.8");
    require(p.deviation_sd >= 0 && p.deviation_sd <= 2, "deviation SD", p.deviation_sd, "must lie in 0 to 2 (of ln r)",
            "use for example 0.1");
    require(p.response_bias >= -0.5 && p.response_bias <= 0.5, "response bias", p.response_bias,
            "must lie in -0.5 to 0.5", "use for example 0.2");
    require(std::abs(p.drift) <= 10, "drift", p.drift, "must lie in -10 to 10 log10 units a hundred presentations",
            "use for example 0.02");
    require(p.fatigue >= 0 && p.fatigue <= 1, "fatigue", p.fatigue, "must lie in 0 to 1", "use for example 0.01");
    require(p.redo_share >= 0 && p.redo_share <= 0.5, "redo share", p.redo_share, "must lie in 0 to 0.5",
            "use for example 0.01");
    require(p.shape.beta > 0 && std::isfinite(p.shape.beta), "steepness", p.shape.beta,
            "must be a finite number above 0", "use for example 3.5");
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
            {"exponent", p.exponent},
            {"deviation_sd", p.deviation_sd},
            {"between_observer_sd", p.between_observer_sd},
            {"common_share", p.common_share},
            {"beta", p.shape.beta},
            {"gamma", p.shape.gamma},
            {"delta", p.shape.delta},
            {"p_threshold", p.shape.p_threshold},
            {"response_bias", p.response_bias},
            {"drift", p.drift},
            {"fatigue", p.fatigue},
            {"redo_share", p.redo_share}};
}

SimulatedObserver::SimulatedObserver(const SimulatedPopulation& population, Random random, double start_s)
    : population_(population),
      traits_(random.stream(1)),
      answers_(random.stream(2)),
      common_effect_(Random(traits_).normal()),
      offset_(threshold_offset(population.shape)),
      start_s_(start_s) {}

double SimulatedObserver::true_slope(Pattern pattern, double contrast) const {
    // A stream of its own for each condition: the slope doesn't depend on the order of the rounds.
    Random random = traits_.stream(static_cast<uint64_t>(pattern) * 1'000'000 + std::llround(contrast * 1000));
    const double effect = std::sqrt(population_.common_share) * common_effect_ +
                          std::sqrt(1 - population_.common_share) * random.normal();
    return median_slope(population_, pattern, contrast) * std::exp(population_.between_observer_sd * effect);
}

double SimulatedObserver::true_radius_texels(const Condition& condition) const {
    constexpr double kPivot_px = 10;
    double ln_radius = std::log(true_slope(condition.pattern, condition.contrast)) +
                       (population_.exponent - 1) * std::log(condition.texel_px / kPivot_px);
    if (population_.deviation_sd > 0) {
        // A stream of its own for each track, as for each slope.
        Random random = traits_.stream(1'000'000'000 + static_cast<uint64_t>(condition.pattern) * 1'000'000 +
                                       std::llround(condition.contrast * 1000));
        ln_radius += population_.deviation_sd *
                     random.stream(static_cast<uint64_t>(std::llround(condition.texel_px * 1000))).normal();
    }
    return std::exp(ln_radius);
}

Answer SimulatedObserver::operator()(const Presentation& shown) const {
    Random random = answers_.stream(static_cast<uint64_t>(shown.number));
    const double hundreds = (shown.number - 1) / 100.0;
    const double threshold = -std::log10(true_radius_texels(shown.condition)) + population_.drift * hundreds;
    const double strength = std::log10(shown.condition.texel_px / shown.radius_px);
    const double lapse = std::min(0.499, population_.shape.delta + population_.fatigue * shown.since_break / 100.0);

    Answer answer;
    // (1 − δ)(1 − e^−u) of the time the observer sees what it is; else the answer is a guess.
    const double u = weibull_exponent(population_.shape, offset_, strength, threshold);
    const double seen = (1 - lapse) * -std::expm1(-u);
    const bool sees = random.uniform() < seen;
    const bool prefers_artifact = random.uniform() < 0.5 + population_.response_bias;
    answer.response = sees ? shown.stimulus : prefers_artifact ? Judgement::artifact : Judgement::line;
    // The closer to the threshold, the longer it takes (a shifted log-normal, as reaction times are); never longer than until
    // the next presentation.
    const double doubt = std::exp(-2 * (strength - threshold) * (strength - threshold));
    answer.response_time_s = std::min(1.75, 0.25 + (0.35 + 0.35 * doubt) * std::exp(0.4 * random.normal()));
    // A clock that needs no memory: presentations come every two seconds, give or take.
    answer.shown_at_s = start_s_ + 2.0 * (shown.number - 1) + 0.2 * random.uniform();
    if (shown.may_redo && random.uniform() < population_.redo_share) answer.action = Action::redo_last;
    return answer;
}

}  // namespace stairstep
