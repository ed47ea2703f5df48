#include "study/engines/quest.h"

#include <numbers>
#include <string>

#include "stimuli/error.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

constexpr double kLargestGrid = 1e6;

void require_valid(const QuestSettings& s) {
    const auto require = [](bool holds, const std::string& subject, const char* problem) {
        if (!holds) throw InputError("QUEST " + subject, problem, "compare the settings with study/engines/quest.h");
    };
    require(std::isfinite(s.guess), "guess", "must be a finite number");
    require(s.guess_sd > 0 && std::isfinite(s.guess_sd), "guess SD", "must be a finite number above 0");
    require(is_valid(s.shape), "psychometric shape",
            "needs beta > 0, gamma and delta in [0, 1), and a threshold probability between them");
    require(s.grain > 0 && s.range > 2 * s.grain && s.range / s.grain <= kLargestGrid, "grid",
            "needs a grain above 0, a range of more than two grains and at most 10^6 points");
}

/// I(x − T) = [dΨ/dT]²/[Ψ(1 − Ψ)], with dΨ/dT = −(1 − δ)(1 − γ)·e^{−u}·u·β·ln 10, u = 10^{β(x − T + ε)}.
double information(const PsychometricShape& s, double offset, double x) {
    const double u = std::pow(10.0, s.beta * (x + offset));
    const double derivative = (1 - s.delta) * (1 - s.gamma) * std::exp(-u) * u * s.beta * std::numbers::ln10;
    const double p = probability_correct(s, offset, x, 0);
    const double variance = p * (1 - p);
    return variance > 0 ? derivative * derivative / variance : 0;
}

}  // namespace

double most_informative_offset(const PsychometricShape& shape) {
    // The information has one peak: golden-section search over the range where u runs from 10⁻³ to 10².
    const double offset = threshold_offset(shape);
    double low = -3 / shape.beta - offset;
    double high = 2 / shape.beta - offset;
    while (high - low > 1e-9) {
        const double span = (high - low) / std::numbers::phi;
        if (information(shape, offset, high - span) < information(shape, offset, low + span)) {
            low = high - span;
        } else {
            high = low + span;
        }
    }
    return (low + high) / 2;
}

double largest_information(const PsychometricShape& shape) {
    return information(shape, threshold_offset(shape), most_informative_offset(shape));
}

Quest::Quest(const QuestSettings& settings) : shape_(settings.shape) {
    require_valid(settings);
    offset_ = threshold_offset(shape_);
    placement_ = most_informative_offset(shape_);
    grain_ = settings.grain;
    const int half = static_cast<int>(std::ceil(settings.range / settings.grain / 2));
    first_threshold_ = settings.guess - half * grain_;
    log_posterior_.resize(2 * static_cast<size_t>(half) + 1);
    for (size_t i = 0; i < log_posterior_.size(); ++i) {
        const double z = (threshold_at(i) - settings.guess) / settings.guess_sd;
        log_posterior_[i] = -z * z / 2;
    }
    summarise();
}

double Quest::suggest() const {
    return mean() + placement_;
}

void Quest::update(double intensity, bool correct) {
    for (size_t i = 0; i < log_posterior_.size(); ++i) {
        log_posterior_[i] += log_likelihood(shape_, offset_, intensity, threshold_at(i), correct);
    }
    ++trials_;
    summarise();
}

double Quest::mean() const {
    return mean_;
}
double Quest::sd() const {
    return sd_;
}

double Quest::quantile(double order) const {
    // Each grid point stands for the cell around it; the mass within a cell is spread evenly.
    double mass = 0;
    for (const double log_p : log_posterior_) mass += std::exp(log_p);
    double below = 0;
    for (size_t i = 0; i < log_posterior_.size(); ++i) {
        const double p = std::exp(log_posterior_[i]);
        if (p > 0 && below + p >= order * mass) return threshold_at(i) + grain_ * ((order * mass - below) / p - 0.5);
        below += p;
    }
    return threshold_at(log_posterior_.size() - 1) + grain_ / 2;
}

Estimate Quest::estimate() const {
    return {mean_, sd_, quantile(0.025), quantile(0.975)};
}

void Quest::summarise() {
    // Keep the largest logarithm at 0, so that the posterior never underflows as a whole.
    const double largest = *std::max_element(log_posterior_.begin(), log_posterior_.end());
    double mass = 0;
    double moment = 0;
    for (size_t i = 0; i < log_posterior_.size(); ++i) {
        log_posterior_[i] -= largest;
        const double p = std::exp(log_posterior_[i]);
        mass += p;
        moment += p * threshold_at(i);
    }
    mean_ = moment / mass;
    double spread = 0;
    for (size_t i = 0; i < log_posterior_.size(); ++i) {
        const double deviation = threshold_at(i) - mean_;
        spread += std::exp(log_posterior_[i]) * deviation * deviation;
    }
    sd_ = std::sqrt(spread / mass);
}

}  // namespace stairstep
