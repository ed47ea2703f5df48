#include "study/engines/staircase.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "stimuli/error.h"

namespace stairstep {
namespace {

/// From T to where a valid staircase converges, under the shape assumed.
double convergence_offset(const StaircaseSettings& s) {
    const auto require = [](bool holds, const std::string& subject, const char* problem) {
        if (!holds) {
            throw InputError("staircase " + subject, problem, "compare the settings with study/engines/staircase.h");
        }
    };
    require(std::isfinite(s.start), "start", "must be a finite number");
    require(s.down_after >= 1, "down_after", "must be at least 1");
    require(s.up_over_down > 0 && std::isfinite(s.up_over_down), "up_over_down", "must be a finite number above 0");
    require(!s.steps.empty() &&
                std::all_of(s.steps.begin(), s.steps.end(), [](double d) { return d > 0 && std::isfinite(d); }),
            "steps", "must be finite numbers above 0, at least one");
    require(s.averaged_reversals >= 2 && s.averaged_reversals % 2 == 0, "averaged_reversals",
            "must be even and above 0");
    PsychometricShape there = s.posterior.shape;
    there.p_threshold = convergence_probability(s);
    require(is_valid(there), "rule", "converges at a probability that the psychometric shape never has");
    return threshold_offset(there) - threshold_offset(s.posterior.shape);
}

}  // namespace

double convergence_probability(const StaircaseSettings& s) {
    return std::pow(s.up_over_down / (s.up_over_down + 1), 1.0 / s.down_after);
}

double weighted_up_over_down(double probability) {
    return probability / (1 - probability);
}

Staircase::Staircase(const StaircaseSettings& settings)
    : settings_(settings),
      posterior_(settings.posterior),
      level_(settings.posterior.guess + settings.start),
      offset_(convergence_offset(settings)) {}

void Staircase::update(double intensity, bool correct) {
    posterior_.update(intensity, correct);
    right_in_a_row_ = correct ? right_in_a_row_ + 1 : 0;
    level_ = intensity;
    if (!correct || right_in_a_row_ == settings_.down_after) {
        right_in_a_row_ = 0;
        const int direction = correct ? -1 : 1;
        if (direction_ == -direction) {
            ++reversals_;
            last_reversals_.push_back(intensity);
            if (std::ssize(last_reversals_) > settings_.averaged_reversals)
                last_reversals_.erase(last_reversals_.begin());
        }
        direction_ = direction;
        const double step = settings_.steps[std::min<size_t>(reversals_, settings_.steps.size() - 1)];
        level_ += correct ? -step : step * settings_.up_over_down;
    }
    const double half = settings_.posterior.range / 2;
    level_ = std::clamp(level_, settings_.posterior.guess - half, settings_.posterior.guess + half);
}

ThresholdEstimate Staircase::estimate() const {
    ThresholdEstimate estimate = posterior_.estimate();
    const std::ptrdiff_t averaged = std::ssize(last_reversals_) / 2 * 2;
    if (averaged == 0) return estimate;
    const double sum = std::accumulate(last_reversals_.end() - averaged, last_reversals_.end(), 0.0);
    estimate.threshold = sum / static_cast<double>(averaged) - offset_;
    estimate.sd = std::hypot(estimate.sd, estimate.threshold - posterior_.mean());
    return estimate;
}

}  // namespace stairstep
