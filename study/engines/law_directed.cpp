#include "study/engines/law_directed.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>

#include "stimuli/error.h"
#include "study/engines/quest.h"

namespace stairstep {
namespace {

constexpr double kLargestGrid = 1e4;
/// Grid points whose share of the posterior is below this part of the largest don't take part in the choice of a trial.
constexpr double kNegligibleShare = 1e-12;
/// Reductions of the variance that differ by less than this part are ties: rounding must not decide.
constexpr double kTie = 1e-9;

void require_valid(const LawDirectedSettings& s) {
    const auto require = [](bool holds, const std::string& subject, const char* problem) {
        if (!holds) {
            throw InputError("law-directed " + subject, problem,
                             "compare the settings with study/engines/law_directed.h");
        }
    };
    require(s.tracks >= 1 && s.tracks <= 1000, "tracks", "must be 1 to 1000");
    require(std::isfinite(s.guess), "guess", "must be a finite number");
    require(s.guess_sd > 0 && std::isfinite(s.guess_sd), "guess SD", "must be a finite number above 0");
    require(s.grain > 0 && s.range > 2 * s.grain && s.range / s.grain <= kLargestGrid, "grid",
            "needs a grain above 0, a range of more than two grains and at most 10^4 points");
    require(std::isfinite(s.deviation_sd) && (s.deviation_sd == 0 || s.deviation_sd >= s.grain / 2), "deviation SD",
            "must be 0, or finite and at least half a grain");
    require(!s.shapes.empty(), "psychometric shapes", "need at least one");
    for (const PsychometricShape& shape : s.shapes) {
        require(is_valid(shape), "psychometric shape",
                "needs beta > 0, gamma and delta in [0, 1), and a threshold probability between them");
        require(shape.p_threshold == s.shapes.front().p_threshold, "psychometric shapes",
                "must have one threshold probability: it says what the threshold means");
    }
    require(s.longest_lead >= 1, "longest lead", "must be at least 1 trial");
}

size_t points_on_each_side(const LawDirectedSettings& s) {
    return static_cast<size_t>(std::ceil(s.range / s.grain / 2));
}

/// So that a bad setting is named before anything is built from it.
const LawDirectedSettings& checked(const LawDirectedSettings& settings) {
    require_valid(settings);
    return settings;
}

/// Mean, SD and 95 % interval of a normalised mass on a grid. Each point stands for the cell around it; the mass within a
/// cell is spread evenly.
ThresholdEstimate summary(std::span<const double> mass, double first, double grain) {
    ThresholdEstimate estimate;
    for (size_t i = 0; i < mass.size(); ++i) estimate.threshold += mass[i] * (first + static_cast<double>(i) * grain);
    for (size_t i = 0; i < mass.size(); ++i) {
        const double deviation = first + static_cast<double>(i) * grain - estimate.threshold;
        estimate.sd += mass[i] * deviation * deviation;
    }
    estimate.sd = std::sqrt(estimate.sd);
    const auto quantile = [&](double order) {
        double below = 0;
        for (size_t i = 0; i < mass.size(); ++i) {
            if (mass[i] > 0 && below + mass[i] >= order) {
                return first + grain * (static_cast<double>(i) + (order - below) / mass[i] - 0.5);
            }
            below += mass[i];
        }
        return first + grain * (static_cast<double>(mass.size()) - 0.5);
    };
    estimate.low = quantile(0.025);
    estimate.high = quantile(0.975);
    return estimate;
}

/// From logarithms to shares that add up to 1.
void normalise(std::vector<double>& logs) {
    const double largest = *std::max_element(logs.begin(), logs.end());
    double sum = 0;
    for (double& value : logs) sum += value = std::exp(value - largest);
    for (double& value : logs) value /= sum;
}

/// Σ weight·mass and Σ weight·moment. Four of each side by side: a sum then doesn't wait for the one before.
struct Sums {
    double mass = 0;
    double moment = 0;
};
Sums weighted_sums(const double* weights, std::span<const double> mass, std::span<const double> moment) {
    constexpr size_t kLanes = 4;
    double masses[kLanes]{}, moments[kLanes]{};
    size_t j = 0;
    for (; j + kLanes <= mass.size(); j += kLanes) {
        for (size_t lane = 0; lane < kLanes; ++lane) {
            masses[lane] += weights[j + lane] * mass[j + lane];
            moments[lane] += weights[j + lane] * moment[j + lane];
        }
    }
    for (; j < mass.size(); ++j) {
        masses[0] += weights[j] * mass[j];
        moments[0] += weights[j] * moment[j];
    }
    return {(masses[0] + masses[1]) + (masses[2] + masses[3]), (moments[0] + moments[1]) + (moments[2] + moments[3])};
}

/// Cov(θ, y)²/Var(y) from the sums over all that is possible and those weighted with the probability of y = 1.
double variance_reduction(const Sums& all, const Sums& right) {
    const double p = right.mass / all.mass;
    const double covariance = (right.moment - p * all.moment) / all.mass;
    const double variance = p * (1 - p);
    return variance > 0 ? covariance * covariance / variance : 0;
}

}  // namespace

std::vector<PsychometricShape> usual_shapes() {
    std::vector<PsychometricShape> shapes;
    for (const double delta : {0.01, 0.06}) {
        for (const double beta : {2.0, 3.5, 6.0}) shapes.push_back({.beta = beta, .delta = delta});
    }
    return shapes;
}

LawDirected::LawDirected(const LawDirectedSettings& settings)
    : shapes_(checked(settings).shapes),
      kernel_(settings.deviation_sd, settings.grain, 2 * points_on_each_side(settings) + 1),
      first_value_(settings.guess - static_cast<double>(points_on_each_side(settings)) * settings.grain),
      grain_(settings.grain),
      longest_lead_(settings.longest_lead),
      log_prior_(kernel_.points()),
      tracks_(static_cast<size_t>(settings.tracks)) {
    const size_t n = kernel_.points();
    placement_ = 0;
    for (const PsychometricShape& shape : shapes_) {
        offsets_.push_back(threshold_offset(shape));
        placement_ += most_informative_offset(shape) / static_cast<double>(shapes_.size());
        for (size_t index = 0; index < 4 * n - 1; ++index) {
            const double above = (static_cast<double>(index) - static_cast<double>(2 * n - 1)) * grain_;
            psi_.push_back(probability_correct(shape, offsets_.back(), 0, above));
        }
    }
    for (size_t i = 0; i < n; ++i) {
        const double z = (value_at(i) - settings.guess) / settings.guess_sd;
        log_prior_[i] = -z * z / 2;
    }
    for (Track& track : tracks_) {
        track.log_likelihood.assign(shapes_.size() * n, 0);
        track.log_evidence.assign(shapes_.size() * n, 0);
    }
    refresh_posterior();
}

void LawDirected::update(int track_index, double intensity, bool correct) {
    assert(track_index >= 0 && track_index < tracks() && std::isfinite(intensity));
    const size_t n = kernel_.points();
    Track& track = tracks_[static_cast<size_t>(track_index)];
    for (size_t s = 0; s < shapes_.size(); ++s) {
        double* block = &track.log_likelihood[s * n];
        for (size_t i = 0; i < n; ++i) {
            block[i] += log_likelihood(shapes_[s], offsets_[s], intensity, value_at(i), correct);
        }
    }
    // One constant for all shapes: what they say of each other stays.
    const double largest = *std::max_element(track.log_likelihood.begin(), track.log_likelihood.end());
    for (double& value : track.log_likelihood) value -= largest;
    for (size_t s = 0; s < shapes_.size(); ++s) {
        kernel_.log_given_law(std::span(track.log_likelihood).subspan(s * n, n),
                              std::span(track.log_evidence).subspan(s * n, n));
    }
    ++track.trials;
    ++trials_;
    refresh_posterior();
}

void LawDirected::refresh_posterior() {
    const size_t n = kernel_.points();
    posterior_.resize(shapes_.size() * n);
    for (size_t s = 0; s < shapes_.size(); ++s) {
        std::copy(log_prior_.begin(), log_prior_.end(), posterior_.begin() + static_cast<ptrdiff_t>(s * n));
    }
    for (const Track& track : tracks_) {
        for (size_t at = 0; at < posterior_.size(); ++at) posterior_[at] += track.log_evidence[at];
    }
    normalise(posterior_);
    std::vector<double> law(n);
    for (size_t at = 0; at < posterior_.size(); ++at) law[at % n] += posterior_[at];
    law_ = summary(law, first_value_, grain_);
}

ThresholdEstimate LawDirected::track_estimate(int track_index) const {
    assert(track_index >= 0 && track_index < tracks());
    const size_t n = kernel_.points();
    const Track& own = tracks_[static_cast<size_t>(track_index)];
    std::vector<double> logs(shapes_.size() * n);
    std::vector<double> others(n);
    for (size_t s = 0; s < shapes_.size(); ++s) {
        others = log_prior_;
        for (const Track& track : tracks_) {
            if (&track == &own) continue;
            for (size_t i = 0; i < n; ++i) others[i] += track.log_evidence[s * n + i];
        }
        kernel_.log_given_track(others, std::span(logs).subspan(s * n, n));
        for (size_t j = 0; j < n; ++j) logs[s * n + j] += own.log_likelihood[s * n + j];
    }
    normalise(logs);
    std::vector<double> thresholds(n);
    for (size_t at = 0; at < logs.size(); ++at) thresholds[at % n] += logs[at];
    return summary(thresholds, first_value_, grain_);
}

std::vector<LawDirected::Joint> LawDirected::joint_with_law(size_t track_index) const {
    const size_t n = kernel_.points();
    const Track& track = tracks_[track_index];
    const double negligible = kNegligibleShare * *std::max_element(posterior_.begin(), posterior_.end());
    std::vector<Joint> joints;
    std::vector<double> law_mass, law_moment;
    for (size_t s = 0; s < shapes_.size(); ++s) {
        const std::span<const double> shares = std::span(posterior_).subspan(s * n, n);
        const std::span<const double> evidence = std::span(track.log_evidence).subspan(s * n, n);
        const std::span<const double> likelihood = std::span(track.log_likelihood).subspan(s * n, n);
        size_t first = 0, last = n;  // of θ: [first, last)
        while (first < n && shares[first] < negligible) ++first;
        if (first == n) continue;
        while (shares[last - 1] < negligible) --last;

        // P(θ_i, t_j) = P(θ_i)·w(j − i)/Z_i·L_j/M_i, M the evidence. `scale` keeps both factors that depend on one index
        // alone in range, wherever the likelihood at these θ isn't smaller than its maximum by hundreds of powers of ten.
        double scale = 0, total = 0;
        for (size_t i = first; i < last; ++i) {
            scale = std::max(scale, -evidence[i]);
            total += shares[i];
        }
        const double log_negligible = std::log(kNegligibleShare / static_cast<double>(n));
        const double highest = *std::max_element(likelihood.begin(), likelihood.end());
        const size_t reach = kernel_.reach(-log_negligible + std::max(0.0, highest + scale));
        // As w/Z ≤ 1, P(t_j) ≤ exp(scale)·L_j: that too bounds the thresholds that need a look.
        size_t low = first - std::min(first, reach), high = std::min(n, last + reach);
        const double needed = log_negligible + std::log(total) - scale;
        while (low < high && likelihood[low] < needed) ++low;
        while (high > low && likelihood[high - 1] < needed) --high;

        law_mass.assign(last - first, 0);
        law_moment.assign(last - first, 0);
        for (size_t i = first; i < last; ++i) {
            law_mass[i - first] = shares[i] * std::exp(-evidence[i] - kernel_.log_row_mass(i) - scale);
            law_moment[i - first] = law_mass[i - first] * (value_at(i) - law_.threshold);
        }
        Joint joint{s, low, {}, {}};
        double found = 0;
        for (size_t j = low; j < high; ++j) {
            const size_t from = std::max(first, j - std::min(j, reach));
            const size_t to = std::max(from, std::min(last, j + reach + 1));
            const Sums sums = weighted_sums(&kernel_.mirrored_weights()[n - 1 + from - j],
                                            std::span(law_mass).subspan(from - first, to - from),
                                            std::span(law_moment).subspan(from - first, to - from));
            const double factor = std::exp(likelihood[j] + scale);
            joint.mass.push_back(sums.mass * factor);
            joint.moment.push_back(sums.moment * factor);
            found += joint.mass.back();
        }

        // The mass is known beforehand. Where plain numbers lost it, once more row by row, each scaled by itself.
        if (!(std::abs(found - total) < 1e-9 * total)) {
            joint = {s, 0, std::vector<double>(n), std::vector<double>(n)};
            std::vector<double> row(n);
            for (size_t i = first; i < last; ++i) {
                for (size_t j = 0; j < n; ++j) row[j] = kernel_.log_weight(j > i ? j - i : i - j) + likelihood[j];
                normalise(row);
                for (size_t j = 0; j < n; ++j) {
                    joint.mass[j] += shares[i] * row[j];
                    joint.moment[j] += shares[i] * row[j] * (value_at(i) - law_.threshold);
                }
            }
        }

        // Ends without mass only cost time.
        size_t leading = 0, kept = joint.mass.size();
        while (leading + 1 < kept && joint.mass[leading] < kNegligibleShare * total) ++leading;
        while (kept > leading + 1 && joint.mass[kept - 1] < kNegligibleShare * total) --kept;
        for (std::vector<double>* values : {&joint.mass, &joint.moment}) {
            values->resize(kept);
            values->erase(values->begin(), values->begin() + static_cast<ptrdiff_t>(leading));
        }
        joint.first += leading;
        joints.push_back(std::move(joint));
    }
    return joints;
}

double LawDirected::expected_variance(int track, double intensity) const {
    assert(track >= 0 && track < tracks() && std::isfinite(intensity));
    Sums all, right;
    for (const Joint& joint : joint_with_law(static_cast<size_t>(track))) {
        for (size_t j = 0; j < joint.mass.size(); ++j) {
            const double p =
                probability_correct(shapes_[joint.shape], offsets_[joint.shape], intensity, value_at(joint.first + j));
            all.mass += joint.mass[j];
            all.moment += joint.moment[j];
            right.mass += p * joint.mass[j];
            right.moment += p * joint.moment[j];
        }
    }
    return std::max(0.0, law_.sd * law_.sd - variance_reduction(all, right));
}

LawDirected::Candidate LawDirected::best_candidate(const std::vector<Joint>& joints) const {
    const size_t n = kernel_.points();
    // Mean and SD of the track's threshold, in grid points.
    Sums all;
    double first_moment = 0, second_moment = 0;
    for (const Joint& joint : joints) {
        for (size_t j = 0; j < joint.mass.size(); ++j) {
            const double at = static_cast<double>(joint.first + j);
            all.mass += joint.mass[j];
            all.moment += joint.moment[j];
            first_moment += joint.mass[j] * at;
            second_moment += joint.mass[j] * at * at;
        }
    }
    const double mean = first_moment / all.mass;
    const double sd = std::sqrt(std::max(0.0, second_moment / all.mass - mean * mean));

    // Intensities as grid points, at most a grid's width beyond the grid. A step of an eighth of the SD: the reduction is
    // flat at its top.
    const auto on_table = [n](double point) {
        const auto width = static_cast<double>(n);
        return static_cast<ptrdiff_t>(std::clamp(std::round(point), -width, 2 * width - 1));
    };
    const double placement = placement_ / grain_;
    const ptrdiff_t first = on_table(mean - 2 * sd + std::min(0.0, 2 * placement));
    const ptrdiff_t last = on_table(mean + 2 * sd + std::max(0.0, 2 * placement));
    const ptrdiff_t step = std::max<ptrdiff_t>(1, std::llround(sd / 8));

    const auto value_of = [this](ptrdiff_t point) { return first_value_ + static_cast<double>(point) * grain_; };
    Candidate best{0, value_of(on_table(mean + placement))};
    for (ptrdiff_t point = first; point <= last; point += step) {
        Sums right;
        for (const Joint& joint : joints) {
            const ptrdiff_t start = static_cast<ptrdiff_t>(joint.shape * (4 * n - 1) + 2 * n - 1 + joint.first) - point;
            const Sums sums = weighted_sums(&psi_[static_cast<size_t>(start)], joint.mass, joint.moment);
            right.mass += sums.mass;
            right.moment += sums.moment;
        }
        const double reduction = variance_reduction(all, right);
        if (reduction > best.reduction) best = {reduction, value_of(point)};
    }
    return best;
}

LawDirected::Suggestion LawDirected::suggest() const {
    const auto open = std::make_unique<bool[]>(tracks_.size());
    std::fill_n(open.get(), tracks_.size(), true);
    return suggest(std::span<const bool>(open.get(), tracks_.size()));
}

LawDirected::Suggestion LawDirected::suggest(std::span<const bool> open) const {
    assert(open.size() == tracks_.size() && std::find(open.begin(), open.end(), true) != open.end());
    // In the order in which ties are decided.
    std::vector<size_t> order;
    for (size_t k = 0; k < tracks_.size(); ++k) {
        if (open[k]) order.push_back(k);
    }
    std::stable_sort(order.begin(), order.end(),
                     [this](size_t a, size_t b) { return tracks_[a].trials < tracks_[b].trials; });

    const int fewest = tracks_[order.front()].trials;
    size_t chosen = order.front();
    Candidate best;
    for (const size_t k : order) {
        if (tracks_[k].trials >= fewest + longest_lead_) continue;
        // Tracks that nothing is known of are all alike, and the first of them goes before the others.
        if (k != order.front() && tracks_[k].trials == 0) continue;
        const Candidate candidate = best_candidate(joint_with_law(k));
        if (k == order.front() || candidate.reduction > best.reduction * (1 + kTie)) {
            best = candidate;
            chosen = k;
        }
    }
    return {static_cast<int>(chosen), best.intensity};
}

}  // namespace stairstep
