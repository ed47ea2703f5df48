#include "study/engines/quest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "stimuli/error.h"
#include "stimuli/number.h"
#include "study/engines/geometric_likelihood.h"

namespace stairstep {
namespace {

constexpr double kLargestGrid = 1e6;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// All in natural logarithms. A factor of one trial below e^−kLargestDrop goes into the point's shift instead; a point
// below e^−kNegligible of the mass doesn't count, and the scale is set anew before the mass itself falls below
// e^−kLeastMass. So what doesn't count is less than e^−50 of the whole, and no factor gets near e^−708, where doubles lose
// digits: after a check it is at least e^−kLeastFactor, and kBudget more may be spent before the next.
constexpr double kLargestDrop = 150;
constexpr double kNegligible = 150;
constexpr double kLeastMass = 100;
constexpr double kLeastFactor = 300;
constexpr double kBudget = 400 - kLargestDrop;

/// Sums run in as many strands as a block has points, so that they needn't wait for each other.
constexpr size_t kBlock = 8;

/// Where the functions of geometric_likelihood.h take over from each other, log10 u.
constexpr double kLog10Tiny = -6;
constexpr double kLog10Small = -3;
constexpr double kLog10Medium = -1.16;
/// e^{−u} is less than 10⁻²⁰ from u = 46.1 on.
constexpr double kLargeU = 46.1;

void require_valid(const QuestSettings& s) {
    const auto require = [](bool holds, const std::string& subject, const char* problem) {
        if (!holds) throw InputError("QUEST " + subject, problem, "compare the settings with study/engines/quest.h");
    };
    require(std::isfinite(s.guess), "guess", "must be a finite number");
    require(s.guess_sd > 0 && std::isfinite(s.guess_sd), "guess SD", "must be a finite number above 0");
    require(is_valid(s.shape), "psychometric shape",
            "needs beta > 0, gamma and delta in [0, 1), and a threshold probability between them");
    require(s.shape.beta >= 1e-6 && s.shape.beta <= 1e6, "beta", "must lie between 10^-6 and 10^6");
    require(s.grain > 0 && s.range > 2 * s.grain && s.range / s.grain <= kLargestGrid, "grid",
            "needs a grain above 0, a range of more than two grains and at most 10^6 points");
    require(!s.quantile_order || (*s.quantile_order > 0 && *s.quantile_order < 1), "quantile order",
            "must lie between 0 and 1");
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
    while (high - low > 1e-9 / shape.beta) {
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

double best_quantile_order(const PsychometricShape& shape) {
    const auto entropy = [](double p) {
        const auto term = [](double q) { return q > 0 ? -q * std::log(q) : 0; };
        return term(p) + term(1 - p);
    };
    const double low = shape.gamma;
    const double high = 1 - shape.delta * (1 - shape.gamma);
    const double best = 1 / (1 + std::exp((entropy(high) - entropy(low)) / (high - low)));
    return (best - low) / (high - low);
}

std::function<double(double)> uniform_log_prior() {
    return [](double) { return 0.0; };
}

Quest::Quest(const QuestSettings& settings) : shape_(settings.shape), placement_(settings.placement) {
    require_valid(settings);
    offset_ = threshold_offset(shape_);
    informative_offset_ = most_informative_offset(shape_);
    quantile_order_ = settings.quantile_order.value_or(best_quantile_order(shape_));
    grain_ = settings.grain;
    const int half = static_cast<int>(std::ceil(settings.range / settings.grain / 2));
    first_threshold_ = settings.guess - half * grain_;
    size_ = 2 * static_cast<size_t>(half) + 1;

    const size_t padded = (size_ + kBlock - 1) / kBlock * kBlock;
    factor_.resize(padded);
    counts_.resize(padded);
    shift_.resize(padded);
    std::fill_n(factor_.begin(), size_, 1.0);
    for (size_t i = 0; i < size_; ++i) {
        const double z = (static_cast<double>(i) - half) * grain_ / settings.guess_sd;
        shift_[i] = settings.log_prior ? settings.log_prior(threshold_at(i)) : -z * z / 2;
        if (!(shift_[i] < kInfinity)) {
            throw InputError("QUEST prior", "is no density at " + format_number(threshold_at(i)),
                             "give the logarithm of a finite density");
        }
    }
    if (*std::max_element(shift_.begin(), shift_.begin() + size_) == -kInfinity) {
        throw InputError("QUEST prior", "is zero on the whole grid", "give one that allows some threshold there");
    }
    powers_.resize(2 * size_ - 1);
    for (size_t k = 0; k < powers_.size(); ++k) {
        powers_[k] = std::pow(10.0, -shape_.beta * grain_ * (static_cast<double>(k) - static_cast<double>(size_ - 1)));
    }
    rescale();
    summarise();
}

double Quest::suggest() const {
    switch (placement_) {
        case QuestPlacement::mean: return mean();
        case QuestPlacement::mode: return mode();
        case QuestPlacement::quantile: return quantile(quantile_order_);
        case QuestPlacement::most_informative: break;
    }
    return mean() + informative_offset_;
}

void Quest::update(double intensity, bool correct) {
    if (!std::isfinite(intensity)) {
        throw InputError("QUEST intensity", "is not finite", "give the intensity that was shown");
    }
    multiply_by_likelihood(intensity, correct);
    ++trials_;
    if (spent_ > kBudget) settle();
    summarise();
    if (mass_ < std::exp(-kLeastMass)) {
        rescale();
        summarise();
    }
}

/// log10 u falls by β·grain from point to point, so the points where u exceeds a bound are the first ones.
size_t Quest::points_where_u_exceeds(double log10_first_u, double log10_u) const {
    const double count = std::ceil((log10_first_u - log10_u) / (shape_.beta * grain_));
    return count > 0 ? static_cast<size_t>(std::min(count, static_cast<double>(size_))) : 0;
}

/// Takes a factor too small for a double out of the points that count.
void Quest::set_aside(size_t i, double log_factor) {
    shift_[i] += log_factor;
    counts_[i] = 0;
}

/// Factors are relative to the largest that the answer allows, 1 − δ(1 − γ) or 1 − γ, so none is above 1.
void Quest::multiply_by_likelihood(double intensity, bool correct) {
    const double step = shape_.beta * grain_;
    const auto log10_u = [&](size_t i) {
        return std::clamp(shape_.beta * (intensity - threshold_at(i) + offset_), -1e300, 1e300);
    };
    const double log10_first_u = log10_u(0);
    // u is taken from its value at the point where it is nearest to 1: its error is least where it matters most.
    const size_t centre =
        static_cast<size_t>(std::clamp(std::round(log10_first_u / step), 0.0, static_cast<double>(size_ - 1)));
    const GeometricSequence u{std::pow(10.0, std::clamp(log10_u(centre), -300.0, 300.0)),
                              powers_.data() + (size_ - 1 - centre)};
    double* factor = factor_.data();

    // A right answer has the factor none + seen·(1 − e^{−u}), a wrong one 1 − (1 − δ)(1 − e^{−u}).
    const double best = 1 - shape_.delta * (1 - shape_.gamma);
    const double none = correct ? shape_.gamma / best : 1;
    const double seen = correct ? (1 - shape_.delta) * (1 - shape_.gamma) / best : -(1 - shape_.delta);
    // As u grows it comes to `all`. Where that is 0, it is e^{−u}: no u is too large to tell thresholds apart.
    const double all = correct ? 1 : shape_.delta;
    const double least_factor = std::exp(-kLargestDrop);
    const double large_u = all > least_factor ? kLargeU - std::log(all) : kLargestDrop;

    size_t i = points_where_u_exceeds(log10_first_u, std::log10(large_u));
    if (all <= least_factor) {
        // Where all points are here, relative to the last: they are told apart however large u is, none counts any more,
        // and the scale is set anew.
        const auto capped_u = [&](size_t k) {
            return std::pow(10.0, std::min(log10_u(k), k + 1 < size_ ? 301.0 : 300.0));
        };
        const double least_u = i == size_ ? capped_u(size_ - 1) : 0;
        for (size_t k = 0; k < i; ++k) {
            set_aside(k, all > 0 ? std::log(all + std::exp(-capped_u(k))) : least_u - capped_u(k));
        }
    } else if (all < 1) {
        for (size_t k = 0; k < i; ++k) factor[k] *= all;
    }
    size_t end = points_where_u_exceeds(log10_first_u, kLog10Medium);
    multiply_by_exponential(factor, u, i, end, all, -seen);
    i = end;
    // Below the last bound, u adds nothing to `none`; where that is 0, the factor is u, as far as doubles reach.
    const double log10_least_u = none > least_factor ? -20 + std::log10(none) : -kLargestDrop / std::numbers::ln10;
    const size_t last_end = points_where_u_exceeds(log10_first_u, log10_least_u);
    end = std::min(last_end, points_where_u_exceeds(log10_first_u, kLog10Small));
    multiply_by_complement(factor, u, i, end, none, seen);
    i = end;
    end = std::min(last_end, points_where_u_exceeds(log10_first_u, kLog10Tiny));
    multiply_by_small_complement(factor, u, i, end, none, seen);
    multiply_by_tiny_complement(factor, u, end, last_end, none, seen);
    if (none <= least_factor) {
        for (i = last_end; i < size_; ++i) {
            set_aside(i, none > 0 ? std::log(none + std::pow(10.0, log10_u(i))) : std::numbers::ln10 * log10_u(i));
        }
    } else if (none < 1) {
        for (i = last_end; i < size_; ++i) factor[i] *= none;
    }
    spent_ += -std::log(std::max(correct ? none : shape_.delta, least_factor));
}

/// Keeps factors away from underflow: a small one goes into its point's shift.
void Quest::settle() {
    for (size_t i = 0; i < size_; ++i) {
        if (factor_[i] >= std::exp(-kLeastFactor)) continue;
        set_aside(i, std::log(factor_[i]));
        factor_[i] = 1;
    }
    spent_ = 0;
}

/// Sets the scale anew, so that the highest point is 1, and decides which points count.
void Quest::rescale() {
    double largest = -kInfinity;
    for (size_t i = 0; i < size_; ++i) {
        if (factor_[i] != 1) shift_[i] += std::log(factor_[i]);
        largest = std::max(largest, shift_[i]);
    }
    for (size_t i = 0; i < size_; ++i) {
        shift_[i] -= largest;
        factor_[i] = 1;
        counts_[i] = shift_[i] >= -kNegligible ? 1 : 0;
        if (counts_[i] == 0) continue;
        factor_[i] = std::exp(shift_[i]);
        shift_[i] = 0;
    }
    spent_ = 0;
}

void Quest::summarise() {
    std::array<double, kBlock> mass{};
    std::array<double, kBlock> moment{};
    std::array<double, kBlock> position{};
    for (size_t k = 0; k < kBlock; ++k) position[k] = static_cast<double>(k);
    for (size_t block = 0; block < factor_.size(); block += kBlock) {
        for (size_t k = 0; k < kBlock; ++k) {
            const double p = factor_[block + k] * counts_[block + k];
            mass[k] += p;
            moment[k] += p * position[k];
            position[k] += kBlock;
        }
    }
    mass_ = 0;
    double total = 0;
    for (size_t k = 0; k < kBlock; ++k) {
        mass_ += mass[k];
        total += moment[k];
    }
    const double last = static_cast<double>(size_ - 1);
    mean_ = first_threshold_ + grain_ * (mass_ > 0 ? std::clamp(total / mass_, 0.0, last) : 0);
}

double Quest::sd() const {
    double spread = 0;
    for (size_t i = 0; i < size_; ++i) {
        const double deviation = threshold_at(i) - mean_;
        spread += factor_[i] * counts_[i] * deviation * deviation;
    }
    return std::sqrt(spread / mass_);
}

double Quest::mode() const {
    size_t best = 0;
    double highest = 0;
    for (size_t i = 0; i < size_; ++i) {
        const double p = factor_[i] * counts_[i];
        if (p > highest) {
            highest = p;
            best = i;
        }
    }
    return threshold_at(best);
}

double Quest::quantile(double order) const {
    // Each grid point stands for the cell around it; the mass within a cell is spread evenly.
    double below = 0;
    for (size_t i = 0; i < size_; ++i) {
        const double p = factor_[i] * counts_[i];
        if (p > 0 && below + p >= order * mass_) {
            return threshold_at(i) + grain_ * (std::max(0.0, order * mass_ - below) / p - 0.5);
        }
        below += p;
    }
    return threshold_at(size_ - 1) + grain_ / 2;
}

ThresholdEstimate Quest::estimate() const {
    return {mean(), sd(), quantile(0.025), quantile(0.975)};
}

}  // namespace stairstep
