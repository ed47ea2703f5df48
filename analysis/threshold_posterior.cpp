#include "analysis/threshold_posterior.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "analysis/overdispersion.h"
#include "analysis/threshold_likelihood.h"
#include "stimuli/gauss_legendre.h"
#include "study/psychometric.h"

namespace stairstep {
namespace {

/// Spacing of T's grid to begin with, log10 units, and the most points it may have.
constexpr double kGrain = 0.03;
constexpr double kMostPoints = 600;
/// The same for strengths over more than a dozen decades.
constexpr double kWideGrain = 0.06;
constexpr double kMostWidePoints = 20000;
/// ln β goes this many prior SDs to either side.
constexpr double kBetaReach = 3;
constexpr size_t kBetas = 11;
constexpr size_t kDeltas = 8;
constexpr size_t kEtas = 8;
/// Overdispersion beyond this is no observer's: ν = 3.
constexpr double kMostEta = 0.5;
/// What counts as an end of T's range, log10 units.
constexpr double kEnd = 0.1;
/// So many different trials are enough to find the posterior's place.
constexpr size_t kFirstSample = 1000;
constexpr size_t kSampleGrowth = 12;
constexpr int kMostPasses = 100;

/// Where the sum runs: an interval for each parameter.
struct Interval {
    double low = 0;
    double high = 0;
    double width() const { return high - low; }
};
struct Window {
    Interval location;
    size_t points = 0;
    Interval ln_beta;
    Interval delta;

    LocationGrid grid() const { return {location.low, location.high, points}; }
    double grain() const { return location.width() / static_cast<double>(points - 1); }
};

/// What one pass over the window found.
struct Sum {
    ThresholdPosterior posterior;
    /// SD of T within one (β, δ, η), root mean square over them: what the grid of T has to resolve.
    double inner_sd = 0;
    double location_mean = 0, location_sd = 0;
    double ln_beta_mean = 0, ln_beta_sd = 0;
    double delta_mean = 0, delta_sd = 0;
    /// Share of the mass at the first and last locations.
    double at_low_edge = 0, at_high_edge = 0;
    /// The mixture itself: e^{…} of each row's grid points, and by how much the row lies off the locations.
    std::vector<double> density;
    std::vector<double> offsets;
};

double sd_of(double mass, double moment, double square) {
    const double mean = moment / mass;
    return std::sqrt(std::max(0.0, square / mass - mean * mean));
}

/// A mixture of the grids of all (β, δ), each moved by its own ε, on one finer grid: for quantiles. Each grid point's mass is
/// spread evenly over a cell, so that the distribution function is a sum of ramps: kept as where they begin and end.
class Mixture {
  public:
    Mixture(double low, double high, double grain)
        : low_(low - grain),
          grain_(grain),
          slope_(static_cast<size_t>((high - low) / grain) + 4),
          value_(slope_.size()) {}

    void add(double t, double cell, double mass) {
        const double from = (t - cell / 2 - low_) / grain_;
        const double to = (t + cell / 2 - low_) / grain_;
        begin_ramp(from, mass / (to - from));
        begin_ramp(to, -mass / (to - from));
    }

    /// Of these ascending orders.
    std::pair<double, double> quantiles(double first, double second) const {
        std::vector<double> below(slope_.size());
        double slope = 0;
        double value = 0;
        for (size_t i = 0; i < below.size(); ++i) {
            value += slope + value_[i];
            slope += slope_[i];
            below[i] = value;
        }
        const auto quantile = [&](double order) {
            const double wanted = order * below.back();
            size_t i = 1;
            while (i + 1 < below.size() && below[i] < wanted) ++i;
            const double mass = below[i] - below[i - 1];
            const double within = mass > 0 ? std::clamp((wanted - below[i - 1]) / mass, 0.0, 1.0) : 0.5;
            return low_ + (static_cast<double>(i - 1) + within) * grain_;
        };
        return {quantile(first), quantile(second)};
    }

  private:
    /// A ramp from x on, in grid units: at the next grid point it has this value, and goes on with its slope.
    void begin_ramp(double x, double slope) {
        const double next = std::clamp(std::ceil(x), 0.0, static_cast<double>(slope_.size() - 1));
        slope_[static_cast<size_t>(next)] += slope;
        value_[static_cast<size_t>(next)] += slope * (next - x);
    }

    double low_;
    double grain_;
    std::vector<double> slope_;
    std::vector<double> value_;
};

Sum sum_over(const std::vector<PooledTrials>& trials, size_t stride, const Window& window, const Interval& range,
             const PosteriorSettings& settings) {
    const size_t points = window.points;
    const double refinement = settings.refinement;
    const size_t beta_count = static_cast<size_t>((kBetas - 1) * refinement) + 1;
    const QuadratureRule delta_rule =
        gauss_legendre(static_cast<size_t>(kDeltas * refinement), window.delta.low, window.delta.high);
    const QuadratureRule eta_rule =
        settings.overdispersed ? gauss_legendre(kEtas, 0, kMostEta) : QuadratureRule{{0}, {1}};
    const std::vector<double>& deltas = delta_rule.nodes;
    const ShapePrior& prior = settings.prior;

    struct Row {
        double ln_beta, delta, eta, offset, log_weight;
    };
    std::vector<Row> rows;
    std::vector<double> log_posterior;
    for (size_t b = 0; b < beta_count; ++b) {
        const double ln_beta =
            window.ln_beta.low + window.ln_beta.width() * static_cast<double>(b) / static_cast<double>(beta_count - 1);
        const double z = (ln_beta - std::log(prior.median_beta)) / prior.ln_beta_sd;
        const double beta = std::exp(ln_beta);
        for (size_t h = 0; h < eta_rule.nodes.size(); ++h) {
            const double eta = eta_rule.nodes[h];
            std::vector<double> block(deltas.size() * points);
            if (settings.overdispersed) {
                add_overdispersed_log_likelihood(block, trials, stride, window.grid(), beta, deltas, eta);
            } else {
                add_log_likelihood(block, trials, stride, window.grid(), beta, deltas);
            }
            log_posterior.insert(log_posterior.end(), block.begin(), block.end());
            for (size_t d = 0; d < deltas.size(); ++d) {
                const PsychometricShape shape{beta, kGuessRate, deltas[d], settings.p_threshold};
                const bool is_end = b == 0 || b + 1 == beta_count;
                rows.push_back(
                    {ln_beta, deltas[d], eta, threshold_offset(shape),
                     -z * z / 2 - deltas[d] / prior.mean_lapse + std::log(delta_rule.weights[d] * (is_end ? 0.5 : 1)) +
                         (settings.overdispersed ? log_overdispersion_prior(eta) : 0) + std::log(eta_rule.weights[h])});
            }
        }
    }

    const double grain = window.grain();
    const auto location = [&](size_t i) { return window.location.low + grain * static_cast<double>(i); };
    const Interval shown{range.low + settings.margin, range.high - settings.margin};
    const auto log_prior_of = [&](double t) {
        const double beyond = std::max({0.0, shown.low - t, t - shown.high}) / settings.beyond_sd;
        return -beyond * beyond / 2;
    };
    double largest = -INFINITY;
    for (size_t r = 0; r < rows.size(); ++r) {
        for (size_t i = 0; i < points; ++i) {
            double& value = log_posterior[r * points + i];
            const double t = location(i) + rows[r].offset;
            if (t < range.low || t > range.high) {
                value = -INFINITY;
                continue;
            }
            value += rows[r].log_weight + log_prior_of(t);
            largest = std::max(largest, value);
        }
    }

    // Moments about the window's middle, so that no digits are lost far from 0.
    const double middle = (window.location.low + window.location.high) / 2;
    double mass = 0, flat_mass = 0, t1 = 0, t2 = 0, l1 = 0, l2 = 0, b1 = 0, b2 = 0, d1 = 0, d2 = 0, e1 = 0, inner = 0;
    Sum sum;
    for (size_t r = 0; r < rows.size(); ++r) {
        double m = 0, s1 = 0, s2 = 0;
        for (size_t i = 0; i < points; ++i) {
            double& p = log_posterior[r * points + i];
            // Less than that is no digit of any sum.
            p = p < largest - 60 ? 0 : std::exp(p - largest);
            if (p == 0) continue;
            const double l = location(i) - middle;
            const double t = l + middle + rows[r].offset;
            m += p;
            s1 += p * l;
            s2 += p * l * l;
            const double flat = t < shown.low || t > shown.high ? p * std::exp(-log_prior_of(t)) : p;
            flat_mass += flat;
            if (t < range.low + kEnd) sum.posterior.low_end_share += flat;
            if (t > range.high - kEnd) sum.posterior.high_end_share += flat;
            if (i == 0) sum.at_low_edge += p;
            if (i + 1 == points) sum.at_high_edge += p;
        }
        const Row& row = rows[r];
        sum.offsets.push_back(row.offset);
        mass += m;
        l1 += s1;
        l2 += s2;
        t1 += s1 + row.offset * m;
        t2 += s2 + 2 * row.offset * s1 + row.offset * row.offset * m;
        if (m > 0) inner += s2 - s1 * s1 / m;
        b1 += m * row.ln_beta;
        b2 += m * row.ln_beta * row.ln_beta;
        d1 += m * row.delta;
        d2 += m * row.delta * row.delta;
        e1 += m * row.eta;
    }
    sum.posterior.mean = middle + t1 / mass;
    sum.posterior.sd = sd_of(mass, t1, t2);
    sum.posterior.low_end_share /= flat_mass;
    sum.posterior.high_end_share /= flat_mass;
    sum.posterior.overdispersion = e1 / mass;
    sum.inner_sd = std::sqrt(std::max(0.0, inner / mass));
    sum.location_mean = middle + l1 / mass;
    sum.location_sd = sd_of(mass, l1, l2);
    sum.ln_beta_mean = b1 / mass;
    sum.ln_beta_sd = sd_of(mass, b1, b2);
    sum.delta_mean = d1 / mass;
    sum.delta_sd = sd_of(mass, d1, d2);
    sum.at_low_edge /= mass;
    sum.at_high_edge /= mass;
    sum.density = std::move(log_posterior);
    return sum;
}

/// Quantiles .025 and .975 of T. Spreading points over cells adds grain²/12 to the variance, which is taken out again.
std::pair<double, double> central_interval(const Sum& sum, const Window& window) {
    const double grain = window.grain();
    const auto [least, most] = std::minmax_element(sum.offsets.begin(), sum.offsets.end());
    Mixture mixture(window.location.low + *least - grain, window.location.high + *most + grain, grain / 8);
    for (size_t r = 0; r < sum.offsets.size(); ++r) {
        for (size_t i = 0; i < window.points; ++i) {
            const double mass = sum.density[r * window.points + i];
            if (mass > 0) {
                mixture.add(window.location.low + grain * static_cast<double>(i) + sum.offsets[r], grain, mass);
            }
        }
    }
    const auto [low, high] = mixture.quantiles(0.025, 0.975);
    const double mean = sum.posterior.mean;
    const double sd = sum.posterior.sd;
    const double shrink = sd / std::hypot(sd, grain / std::sqrt(12.0));
    return {mean + shrink * (low - mean), mean + shrink * (high - mean)};
}

/// The locations that can matter, from a look at a few shapes: the median, and the ends of what the prior allows. Where none of
/// them leaves a likelihood worth mentioning, no shape between them does.
Interval likely_locations(const std::vector<PooledTrials>& trials, size_t stride, const Window& window,
                          const ShapePrior& prior) {
    constexpr double kNegligible = 25;  // e^−25 of the largest
    const std::vector<double> deltas{prior.mean_lapse, prior.largest_lapse};
    std::vector<double> best(window.points, -INFINITY);
    for (const double ln_beta : {window.ln_beta.low, std::log(prior.median_beta), window.ln_beta.high}) {
        std::vector<double> block(deltas.size() * window.points);
        add_log_likelihood(block, trials, stride, window.grid(), std::exp(ln_beta), deltas);
        const double z = (ln_beta - std::log(prior.median_beta)) / prior.ln_beta_sd;
        for (size_t d = 0; d < deltas.size(); ++d) {
            const double log_weight = -z * z / 2 - deltas[d] / prior.mean_lapse;
            for (size_t i = 0; i < window.points; ++i) {
                best[i] = std::max(best[i], block[d * window.points + i] + log_weight);
            }
        }
    }
    const double least = *std::max_element(best.begin(), best.end()) - kNegligible;
    size_t first = 0;
    size_t last = window.points - 1;
    while (best[first] < least) ++first;
    while (best[last] < least) --last;
    const LocationGrid grid = window.grid();
    return {first > 0 ? grid.at(first - 1) : window.location.low,
            last + 1 < window.points ? grid.at(last + 1) : window.location.high};
}

/// mean ± reach, within limits, but no narrower than `least` on either side.
Interval around(double mean, double reach, double least, const Interval& limits) {
    const double half = std::max(reach, least);
    return {std::max(limits.low, mean - half), std::min(limits.high, mean + half)};
}

}  // namespace

ThresholdPosterior threshold_posterior(const std::vector<PooledTrials>& pooled, const PosteriorSettings& settings) {
    assert(!pooled.empty());
    const ShapePrior& prior = settings.prior;
    const Interval range{pooled.front().strength - settings.margin, pooled.back().strength + settings.margin};
    const double beta_reach = kBetaReach * prior.ln_beta_sd;
    const Interval all_betas{std::log(prior.median_beta) - beta_reach, std::log(prior.median_beta) + beta_reach};
    const Interval all_deltas{0, prior.largest_lapse};

    // Locations are T − ε; ε is largest in size at the least β, and grows with δ.
    Interval all_locations = range;
    for (const double delta : {all_deltas.low, all_deltas.high}) {
        const double offset = threshold_offset({std::exp(all_betas.low), kGuessRate, delta, settings.p_threshold});
        all_locations.low = std::min(all_locations.low, range.low - offset);
        all_locations.high = std::max(all_locations.high, range.high - offset);
    }
    const double refinement = settings.refinement;
    const auto even_points = [&](double width, double grain) {
        return 2 * static_cast<size_t>(std::clamp(width / grain * refinement / 2, 8.0, kMostPoints / 2 * refinement)) +
               2;
    };
    // Strengths that lie many decades apart: more points, so that no likelihood falls between two of them.
    const auto first_points = [&](double width) {
        const size_t points = even_points(width, kGrain);
        if (width / static_cast<double>(points - 1) <= kWideGrain) return points;
        return 2 * static_cast<size_t>(std::min(width / kWideGrain, kMostWidePoints) / 2) + 2;
    };
    Window window{all_locations, first_points(all_locations.width()), all_betas, all_deltas};

    size_t stride = std::max<size_t>(1, (pooled.size() + kFirstSample - 1) / kFirstSample);
    if (!settings.overdispersed) {
        window.location = likely_locations(pooled, stride, window, prior);
        window.points = first_points(window.location.width());
    }
    for (int pass = 0;; ++pass) {
        Sum sum = sum_over(pooled, stride, window, range, settings);
        const double grain = window.grain();
        Window next = window;
        bool settled = true;
        if (pass < kMostPasses && grain * refinement > 0.75 * sum.inner_sd) {
            next.location = around(sum.location_mean, 7 * sum.location_sd, 3 * grain, all_locations);
            const double fine = std::max(sum.inner_sd / 2, next.location.width() / kMostPoints);
            next.points = even_points(next.location.width(), fine);
            settled = false;
        }
        const double beta_spacing = window.ln_beta.width() / (kBetas - 1);
        if (pass < kMostPasses && beta_spacing > 1.1 * sum.ln_beta_sd) {
            next.ln_beta = around(sum.ln_beta_mean, 5 * sum.ln_beta_sd, 2 * beta_spacing, all_betas);
            settled = false;
        }
        if (pass < kMostPasses && window.delta.width() > 12 * sum.delta_sd) {
            next.delta = around(sum.delta_mean, 5 * sum.delta_sd, window.delta.width() / 8, all_deltas);
            settled = false;
        }
        // A window that a part of the trials chose too narrow.
        constexpr double kLittle = 1e-9;
        if (settled && pass < kMostPasses &&
            ((sum.at_low_edge > kLittle && window.location.low > all_locations.low) ||
             (sum.at_high_edge > kLittle && window.location.high < all_locations.high))) {
            next.location = around(sum.location_mean, window.location.width(), 0, all_locations);
            // Half a step more: rounding must not decide how often the step goes into a multiple of itself.
            next.points = even_points(next.location.width() + grain / 2, grain);
            settled = false;
        }
        if (settled) {
            if (stride == 1 || pass >= kMostPasses) {
                sum.posterior.ci95 = central_interval(sum, window);
                return sum.posterior;
            }
            stride = std::max<size_t>(1, stride / kSampleGrowth);
            // Fewer trials left the window wide enough for more of them; points of the grid are added when needed.
            next.location = around(sum.location_mean, 7 * sum.location_sd, 3 * grain, all_locations);
            next.points = even_points(next.location.width(), grain);
        }
        window = next;
    }
}

}  // namespace stairstep
