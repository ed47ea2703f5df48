#include "analysis/random_effects.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "analysis/statistics.h"

namespace stairstep {
namespace {

/// The variances that a likelihood is made of. Where neither τ nor an observer's error leaves any, a share of the values' own
/// scale that is too small to matter keeps weights finite.
double variance_of(const Effect& effect, double tau_squared, double least) {
    return std::max(tau_squared + effect.se * effect.se, least);
}

double least_variance(std::span<const Effect> effects) {
    double scale = 0;
    for (const Effect& e : effects) scale = std::max({scale, e.se, std::abs(e.value - effects.front().value)});
    return scale > 0 ? 1e-20 * scale * scale : 1;
}

double weighted_mean(std::span<const Effect> effects, double tau_squared, double least) {
    double weights = 0;
    double sum = 0;
    for (const Effect& e : effects) {
        const double w = 1 / variance_of(e, tau_squared, least);
        weights += w;
        // From the first value on, so that equal values have their mean exactly.
        sum += w * (e.value - effects.front().value);
    }
    return effects.front().value + sum / weights;
}

/// ln of a product, taken of several factors at a time: logarithms are what a likelihood of few observers costs. Four of the
/// smallest variances, 10⁻³⁸ or so, are still a double.
class LogOfProduct {
  public:
    void multiply(double factor) {
        product_ *= factor;
        if (++factors_ == 4) {
            sum_ += std::log(product_);
            product_ = 1;
            factors_ = 0;
        }
    }
    double value() const { return factors_ > 0 ? sum_ + std::log(product_) : sum_; }

  private:
    double product_ = 1;
    double sum_ = 0;
    int factors_ = 0;
};

/// ℓ at (μ, τ²), less its constant.
double log_likelihood_at(std::span<const Effect> effects, double mean, double tau_squared, double least) {
    LogOfProduct variances;
    double squares = 0;
    for (const Effect& e : effects) {
        const double variance = variance_of(e, tau_squared, least);
        variances.multiply(variance);
        squares += (e.value - mean) * (e.value - mean) / variance;
    }
    return -(variances.value() + squares) / 2;
}

double restricted_log_likelihood(std::span<const Effect> effects, double tau_squared, double least) {
    double weights = 0;
    for (const Effect& e : effects) weights += 1 / variance_of(e, tau_squared, least);
    return log_likelihood_at(effects, weighted_mean(effects, tau_squared, least), tau_squared, least) -
           std::log(weights) / 2;
}

/// Where f is largest over τ² ≥ 0: a likelihood may have two maxima, so the best of a coarse scan is refined.
template <typename F>
double maximise_over_tau_squared(double largest, const F& f) {
    constexpr int kSteps = 40;
    if (!(largest > 0)) return 0;
    const auto at = [&](int i) { return i == 0 ? 0.0 : largest * std::pow(10.0, 10.0 * (i - kSteps) / kSteps); };
    int best = 0;
    double best_value = f(0.0);
    for (int i = 1; i <= kSteps; ++i) {
        if (const double value = f(at(i)); value > best_value) {
            best = i;
            best_value = value;
        }
    }
    // Brent's method, in units of the bracket: f is smooth, and half of a double's digits are what its maximum can be told to.
    constexpr int kBits = std::numeric_limits<double>::digits / 2 + 2;
    const double high = at(std::min(kSteps, best + 1));
    const double inner = high * boost::math::tools::brent_find_minima([&](double x) { return -f(high * x); },
                                                                      at(std::max(0, best - 1)) / high, 1.0, kBits)
                                    .first;
    return f(inner) > f(0.0) ? inner : 0;
}

/// No likelihood has its maximum beyond: there every deviation counts for less than the variance it needs.
double largest_tau_squared(std::span<const Effect> effects, double mean_low, double mean_high) {
    const auto [low, high] = std::minmax_element(effects.begin(), effects.end(),
                                                 [](const Effect& a, const Effect& b) { return a.value < b.value; });
    const double range = std::max(high->value, mean_high) - std::min(low->value, mean_low);
    return static_cast<double>(effects.size()) * range * range;
}

double largest_tau_squared(std::span<const Effect> effects) {
    return largest_tau_squared(effects, effects.front().value, effects.front().value);
}

/// All but the interval.
RandomEffects at_tau_squared(std::span<const Effect> effects, double tau_squared) {
    const double n = static_cast<double>(effects.size());
    const double least = least_variance(effects);
    RandomEffects fit;
    fit.tau = std::sqrt(tau_squared);
    fit.mean = weighted_mean(effects, tau_squared, least);
    double weights = 0;
    double squares = 0;
    for (const Effect& e : effects) {
        const double w = 1 / variance_of(e, tau_squared, least);
        fit.weight.push_back(w);
        weights += w;
        squares += w * (e.value - fit.mean) * (e.value - fit.mean);
    }
    for (double& w : fit.weight) w /= weights;
    fit.model_se = 1 / std::sqrt(weights);
    fit.ci95 = {fit.mean, fit.mean};
    if (effects.size() >= 2) fit.se = std::sqrt(squares / (n - 1) / weights);
    return fit;
}

RandomEffects with_interval(RandomEffects fit, size_t observers) {
    if (observers >= 2) {
        const double half_width = t_quantile(0.975, static_cast<double>(observers) - 1) * fit.se;
        fit.ci95 = {fit.mean - half_width, fit.mean + half_width};
    }
    return fit;
}

/// The outermost x beyond `inside` where within(x) still holds; it must fail far enough out.
template <typename F>
double edge_of(double inside, double step, const F& within) {
    double out = inside + step;
    while (within(out)) {
        inside = out;
        step *= 2;
        out = inside + step;
    }
    for (int i = 0; i < 200 && std::abs(out - inside) > 1e-12 * std::max(std::abs(out), std::abs(inside)); ++i) {
        const double middle = (inside + out) / 2;
        if (middle == inside || middle == out) break;
        (within(middle) ? inside : out) = middle;
    }
    return (inside + out) / 2;
}

}  // namespace

RandomEffects random_effects_at(std::span<const Effect> effects, double tau) {
    assert(!effects.empty());
    return with_interval(at_tau_squared(effects, tau * tau), effects.size());
}

RandomEffects estimate_random_effects(std::span<const Effect> effects, TauMethod method) {
    assert(!effects.empty());
    const double least = least_variance(effects);
    const double tau_squared = maximise_over_tau_squared(largest_tau_squared(effects), [&](double candidate) {
        return method == TauMethod::reml
                   ? restricted_log_likelihood(effects, candidate, least)
                   : log_likelihood_at(effects, weighted_mean(effects, candidate, least), candidate, least);
    });
    return at_tau_squared(effects, tau_squared);
}

RandomEffects fit_random_effects(std::span<const Effect> effects, TauMethod method) {
    return with_interval(estimate_random_effects(effects, method), effects.size());
}

SandwichInterval sandwich_interval(std::span<const Effect> effects, const RandomEffects& fit) {
    assert(effects.size() >= 2 && fit.weight.size() == effects.size());
    double variance = 0;
    double sum = 0;
    double pairs = 0;  // Σ_{i≠j} a_i a_j
    double weights_squared = 0;
    for (size_t j = 0; j < effects.size(); ++j) {
        const double p = fit.weight[j];
        // One observer's estimate to all digits has residuals of rounding errors: a share that leaves some.
        const double a = p * p / std::max(1 - p, 1e-9);
        const double e = effects[j].value - fit.mean;
        variance += a * e * e;
        pairs += 2 * a * sum;
        sum += a;
        weights_squared += p * p;
    }
    // With cov(e_i, e_j) = (1/Σw)·([i = j]/p_j − 1): E(V) = 1/Σw and Var(V) = 2·Σ a_i a_j cov_ij².
    const double largest = static_cast<double>(effects.size()) - 1;
    SandwichInterval result;
    result.se = std::sqrt(variance);
    result.degrees_of_freedom = std::clamp(1 / (weights_squared + pairs), 1.0, largest);
    const double half_width = t_quantile(0.975, result.degrees_of_freedom) * result.se;
    result.ci95 = {fit.mean - half_width, fit.mean + half_width};
    return result;
}

double profile_bound(size_t observers) {
    assert(observers >= 2);
    const double n = static_cast<double>(observers);
    const double t = t_quantile(0.975, n - 1);
    return n * std::log1p(t * t / (n - 1));
}

ProfileInterval profile_likelihood(std::span<const Effect> effects, double bound) {
    assert(effects.size() >= 2);
    const double least = least_variance(effects);
    const RandomEffects ml = estimate_random_effects(effects, TauMethod::ml);
    const double top = log_likelihood_at(effects, ml.mean, ml.tau * ml.tau, least);
    const auto within = [&](double mean) {
        const double tau_squared = maximise_over_tau_squared(
            largest_tau_squared(effects, mean, mean),
            [&](double candidate) { return log_likelihood_at(effects, mean, candidate, least); });
        return 2 * (top - log_likelihood_at(effects, mean, tau_squared, least)) <= bound;
    };
    // Without a spread and without errors, only the common value itself is likely.
    if (largest_tau_squared(effects) == 0 &&
        std::all_of(effects.begin(), effects.end(), [](const Effect& e) { return e.se == 0; })) {
        return {ml.mean, {ml.mean, ml.mean}};
    }
    return {ml.mean, {edge_of(ml.mean, -ml.model_se, within), edge_of(ml.mean, ml.model_se, within)}};
}

Posterior random_effects_posterior(std::span<const Effect> effects, double tau_scale) {
    assert(effects.size() >= 2 && tau_scale > 0);
    const double least = least_variance(effects);
    // τ = s·tan(πu/2) for u at the middles of equal cells of (0, 1): s, of the data's own size, puts them where they count.
    double scale = std::sqrt(least);
    std::vector<double> values;
    std::vector<double> errors;
    for (const Effect& e : effects) {
        values.push_back(e.value);
        errors.push_back(e.se);
    }
    scale = std::max({scale, mean_with_interval(values).sd, median(errors)});
    constexpr int kCells = 800;
    struct Cell {
        double log_mass, tau, mean, sd;
    };
    std::vector<Cell> cells;
    double top = -INFINITY;
    for (int i = 0; i < kCells; ++i) {
        const double angle = std::numbers::pi / 2 * (i + 0.5) / kCells;
        const double tau = scale * std::tan(angle);
        const RandomEffects at = at_tau_squared(effects, tau * tau);
        const double log_prior = -std::log1p(tau / tau_scale * (tau / tau_scale));
        const double log_mass =
            restricted_log_likelihood(effects, tau * tau, least) + log_prior - 2 * std::log(std::cos(angle));
        cells.push_back({log_mass, tau, at.mean, at.model_se});
        top = std::max(top, log_mass);
    }
    double mass = 0;
    for (const Cell& cell : cells) mass += std::exp(cell.log_mass - top);
    // What sums run over: shares below a rounding error of a quantile are left out.
    struct Component {
        double share, mean, sd;
    };
    std::vector<Component> components;
    for (const Cell& cell : cells) {
        const double share = std::exp(cell.log_mass - top) / mass;
        if (share > 1e-14) components.push_back({share, cell.mean, cell.sd});
    }

    const auto mean_below = [&](double mean) {
        double below = 0;
        for (const Component& c : components) below += c.share * normal_cdf((mean - c.mean) / c.sd);
        return below;
    };
    const RandomEffects fit = fit_random_effects(effects);
    const auto mean_at = [&](double p) {
        double low = fit.mean;
        double high = fit.mean;
        for (double step = std::max(fit.se, fit.model_se); mean_below(low) > p; step *= 2) low = fit.mean - step;
        for (double step = std::max(fit.se, fit.model_se); mean_below(high) < p; step *= 2) high = fit.mean + step;
        if (low == high) return low;
        std::uintmax_t most = 100;
        const auto [below, above] =
            boost::math::tools::toms748_solve([&](double m) { return mean_below(m) - p; }, low, high,
                                              boost::math::tools::eps_tolerance<double>(40), most);
        return (below + above) / 2;
    };
    const auto tau_at = [&](double p) {
        double below = 0;
        for (size_t i = 0; i < cells.size(); ++i) {
            const double share = std::exp(cells[i].log_mass - top) / mass;
            if (below + share >= p) {
                // Within a cell as if its mass were even between its neighbours' middles.
                const double from = i > 0 ? (cells[i - 1].tau + cells[i].tau) / 2 : 0;
                const double to = i + 1 < cells.size() ? (cells[i].tau + cells[i + 1].tau) / 2 : cells[i].tau;
                return from + (to - from) * (p - below) / share;
            }
            below += share;
        }
        return cells.back().tau;
    };
    return {mean_at(0.5), tau_at(0.5), {mean_at(0.025), mean_at(0.975)}, {tau_at(0.025), tau_at(0.975)}};
}

}  // namespace stairstep
