#include "study/engines/psychtoolbox_quest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "stimuli/error.h"
#include "stimuli/number.h"

// Sums run from the lowest index to the highest, and products stand in Psychtoolbox's order: where the posterior passes
// through denormal numbers, another order would change more than the last digit.

namespace stairstep {
namespace {

constexpr double kLargestGrid = 1e6;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

void require_valid(const PsychtoolboxQuestSettings& s) {
    const auto require = [](bool holds, const char* subject, const char* problem) {
        if (!holds) {
            throw InputError(subject, problem, "compare the settings with study/engines/psychtoolbox_quest.h");
        }
    };
    const auto above_zero = [](double value) { return value > 0 && std::isfinite(value); };
    require(std::isfinite(s.guess), "QUEST guess", "must be a finite number");
    require(above_zero(s.guess_sd), "QUEST guess SD", "must be a finite number above 0");
    require(above_zero(s.shape.beta), "QUEST beta", "must be a finite number above 0");
    require(s.shape.gamma >= 0 && s.shape.gamma < 1, "QUEST gamma", "must be at least 0 and below 1");
    require(s.shape.delta >= 0 && s.shape.delta < 1, "QUEST delta", "must be at least 0 and below 1");
    require(s.shape.p_threshold > 0 && s.shape.p_threshold < 1, "QUEST p-threshold", "must lie between 0 and 1");
    require(above_zero(s.grain), "QUEST grain", "must be a finite number above 0");
    if (!s.range) return;
    require(above_zero(*s.range), "QUEST range", "must be a finite number above 0");
    require(*s.range / s.grain <= kLargestGrid, "QUEST range", "must be at most 10^6 grains");
}

struct Point {
    double x = 0;
    double y = 0;
};

/// Octave's interp1 at t, linear, over points of rising x; NaN outside of them. Of points with one x, the later holds.
double interpolate(const std::vector<Point>& points, double t) {
    if (!(t >= points.front().x && t <= points.back().x)) return std::numeric_limits<double>::quiet_NaN();
    const auto above = std::upper_bound(points.begin(), points.end() - 1, t,
                                        [](double value, const Point& point) { return value < point.x; });
    const Point& right = *above;
    const Point& left = *(above - 1);
    return (right.y - left.y) / (right.x - left.x) * (t - left.x) + left.y;
}

/// Ψ at the intensities (k − dim)·grain + shift relative to threshold, k = 0 … 2·dim.
std::vector<double> psychometric_table(const PsychometricShape& s, double gamma, int dim, double grain, double shift) {
    std::vector<double> table;
    for (int k = -dim; k <= dim; ++k) {
        const double u = std::pow(10.0, s.beta * (k * grain + shift));
        table.push_back(s.delta * gamma + (1 - s.delta) * (1 - (1 - gamma) * std::exp(-u)));
    }
    return table;
}

/// The intensity at which the table, made without a shift, reaches p_threshold.
double interpolated_threshold(const std::vector<double>& table, int dim, double grain, double p_threshold) {
    if (table.front() > p_threshold || table.back() < p_threshold) {
        throw InputError("QUEST p-threshold", "lies outside what the psychometric function reaches within the range",
                         "choose it between " + format_number(table.front()) + " and " + format_number(table.back()));
    }
    std::vector<Point> rising;
    for (int k = 0; k < 2 * dim; ++k) {
        if (table[k + 1] != table[k]) rising.push_back({table[k], (k - dim) * grain});
    }
    if (rising.size() < 2) {
        throw InputError("QUEST grain", "is so coarse that the psychometric function is a step", "choose a finer one");
    }
    std::stable_sort(rising.begin(), rising.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    const double threshold = interpolate(rising, p_threshold);
    if (!std::isfinite(threshold)) {
        throw InputError("QUEST p-threshold", "can't be found in the table of the psychometric function",
                         "choose one farther from its ends, or a finer grain");
    }
    return threshold;
}

/// Pelli's best order of the quantile to test at, with his guard against 0·log 0; derived in study/engines/quest.h.
double quantile_order_of(double low, double high) {
    const double difference = high * std::log(high + kEpsilon) - low * std::log(low + kEpsilon) +
                              (1 - high + kEpsilon) * std::log(1 - high + kEpsilon) -
                              (1 - low + kEpsilon) * std::log(1 - low + kEpsilon);
    const double best = 1 / (1 + std::exp(difference / (low - high)));
    return (best - low) / (high - low);
}

}  // namespace

PsychtoolboxQuest::PsychtoolboxQuest(const PsychtoolboxQuestSettings& settings) {
    require_valid(settings);
    const PsychometricShape& shape = settings.shape;
    guess_ = settings.guess;
    grain_ = settings.grain;
    gamma_ = shape.gamma > shape.p_threshold ? 0.5 : shape.gamma;
    half_ = settings.range ? std::ceil(*settings.range / grain_ / 2) : 250;
    const int dim = 2 * static_cast<int>(half_);

    pdf_.resize(dim + 1);
    last_ = pdf_.size();
    for (size_t i = 0; i < pdf_.size(); ++i) {
        const double z = x(i) / settings.guess_sd;
        pdf_[i] = std::exp(-0.5 * (z * z));
    }
    // Psychtoolbox divides by the sum twice: over the prior, and over the (empty) history.
    sum_up();
    for (double& p : pdf_) p /= sum_;
    sum_up();

    const std::vector<double> unshifted = psychometric_table(shape, gamma_, dim, grain_, 0);
    x_threshold_ = interpolated_threshold(unshifted, dim, grain_, shape.p_threshold);
    right_ = psychometric_table(shape, gamma_, dim, grain_, x_threshold_);
    quantile_order_ = quantile_order_of(right_.front(), right_.back());
    std::reverse(right_.begin(), right_.end());
    for (const double p : right_) wrong_.push_back(1 - p);
}

void PsychtoolboxQuest::update(double intensity, bool correct) {
    if (!std::isfinite(intensity)) {
        throw InputError("QUEST intensity", format_number(intensity) + " is not finite", "give what was shown");
    }
    const double shown = std::max(-1e10, std::min(1e10, intensity));
    // Where the stretch of the table starts, counted from 0.
    const double start = half_ - std::round((shown - guess_) / grain_);
    const double largest_start = static_cast<double>(right_.size() - pdf_.size());
    if (start < 0 || start > largest_start) ++clamped_trials_;
    const size_t from = static_cast<size_t>(std::clamp(start, 0.0, largest_start));
    const double* likelihood = (correct ? right_ : wrong_).data() + from;

    // The last trial's division, this one's product and its sum in one pass. The sum has to wait for itself; a block at a
    // time, the rest is done meanwhile.
    constexpr size_t kBlock = 8;
    double sum = 0;
    size_t i = first_;
    for (; i + kBlock <= last_; i += kBlock) {
        double product[kBlock];
        for (size_t k = 0; k < kBlock; ++k) product[k] = pdf_[i + k] / sum_ * likelihood[i + k];
        for (size_t k = 0; k < kBlock; ++k) pdf_[i + k] = product[k];
        for (size_t k = 0; k < kBlock; ++k) sum += product[k];
    }
    for (; i < last_; ++i) {
        pdf_[i] = pdf_[i] / sum_ * likelihood[i];
        sum += pdf_[i];
    }
    sum_ = sum;
    find_support();
    ++trials_;
}

void PsychtoolboxQuest::sum_up() {
    sum_ = 0;
    for (const double p : pdf_) sum_ += p;
    find_support();
}

void PsychtoolboxQuest::find_support() {
    if (sum_ == 0) {  // all points are 0/0 from now on
        first_ = 0;
        last_ = pdf_.size();
        return;
    }
    while (pdf_[first_] == 0) ++first_;
    while (pdf_[last_ - 1] == 0) --last_;
}

double PsychtoolboxQuest::mean() const {
    double sum = 0;
    double moment = 0;
    for (size_t i = first_; i < last_; ++i) {
        sum += pdf(i);
        moment += pdf(i) * x(i);
    }
    return guess_ + moment / sum;
}

double PsychtoolboxQuest::mode() const {
    size_t best = first_;
    for (size_t i = first_; i < last_; ++i) {
        if (pdf(i) > pdf(best)) best = i;
    }
    return x(best) + guess_;
}

double PsychtoolboxQuest::sd() const {
    double sum = 0;
    double moment = 0;
    double second = 0;
    for (size_t i = first_; i < last_; ++i) {
        sum += pdf(i);
        moment += pdf(i) * x(i);
        second += pdf(i) * (x(i) * x(i));
    }
    const double mean = moment / sum;
    const double variance = second / sum - mean * mean;
    return variance < 0 ? 0 : std::sqrt(variance);
}

double PsychtoolboxQuest::quantile(double order) const {
    if (!(order >= 0 && order <= 1)) {
        throw InputError("quantile order", format_number(order) + " is no probability", "choose one from 0 to 1");
    }
    std::vector<Point> rising{{pdf(0), x(0)}};
    double sum = 0;
    for (size_t i = first_; i < last_; ++i) {
        const double before = sum;
        sum += pdf(i);
        if (i > 0 && sum > before) rising.push_back({sum, x(i)});
    }
    if (!std::isfinite(sum)) {
        throw FailureError("QUEST posterior", "has vanished: no threshold can have given these answers",
                           "use a delta above 0 or another engine");
    }
    if (order < pdf(0)) return guess_ + x(0);
    if (order > sum) return guess_ + x(pdf_.size() - 1);
    if (rising.size() < 2) {
        throw FailureError("QUEST posterior", "lies on the grid's lowest point alone", "use a larger range");
    }
    return guess_ + interpolate(rising, order * sum);
}

}  // namespace stairstep
