#include "analysis/threshold_likelihood.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "analysis/overdispersion.h"
#include "study/engines/geometric_likelihood.h"

namespace stairstep {
namespace {

/// Factors that are multiplied before their logarithm is taken: each is at least δ/2, and 10⁻⁷ at the very least.
constexpr int kFactorsALogarithm = 40;

using Lanes [[gnu::vector_size(2 * sizeof(double))]] = double;

/// product[i] *= a + b·e[i], for an even count.
void multiply(double* product, const double* e, size_t count, double a, double b) {
    for (size_t i = 0; i < count; i += 2) {
        Lanes p, x;
        std::memcpy(&p, product + i, sizeof p);
        std::memcpy(&x, e + i, sizeof x);
        p *= a + b * x;
        std::memcpy(product + i, &p, sizeof p);
    }
}

/// log_sum[i] += count·ln(product[i]), and product[i] = 1 again.
void take_logarithm(double* log_sum, double* product, size_t points, double count) {
    for (size_t i = 0; i < points; ++i) {
        log_sum[i] += count * std::log(product[i]);
        product[i] = 1;
    }
}

/// e^{−u} of one strength at all locations, u = 10^{β(x − L)}.
class SeenTable {
  public:
    SeenTable(const LocationGrid& grid, double beta) : first_(grid.first), spacing_(grid.spacing()), beta_(beta) {
        // From where u would exceed 700 to where 1 − e^{−u} can't be told from 0.
        const double decades = std::log10(700.0) + 18;
        const size_t count = std::min<double>(static_cast<double>(grid.points), decades / (beta * spacing_)) + 2;
        powers_.resize(count);
        for (size_t k = 0; k < count; ++k) powers_[k] = std::pow(10.0, -beta * spacing_ * static_cast<double>(k));
    }

    void fill(std::vector<double>& e, double strength) const {
        const double points = static_cast<double>(e.size());
        const double exponent = beta_ * (strength - first_);  // of u at the first location
        const double begin = std::clamp(std::ceil((exponent - std::log10(700.0)) / (beta_ * spacing_)), 0.0, points);
        const size_t from = static_cast<size_t>(begin);
        const size_t to = std::min(e.size(), from + powers_.size());
        std::fill(e.begin(), e.begin() + from, 0.0);
        std::fill(e.begin() + from, e.end(), 1.0);
        const double scale = std::pow(10.0, std::clamp(exponent - beta_ * spacing_ * begin, -300.0, std::log10(700.0)));
        multiply_by_exponential(e.data() + from, {scale, powers_.data()}, 0, to - from, 0, 1);
    }

  private:
    double first_;
    double spacing_;
    double beta_;
    std::vector<double> powers_;
};

}  // namespace

std::vector<PooledTrials> pool(std::vector<PooledTrials> trials) {
    std::sort(trials.begin(), trials.end(), [](const PooledTrials& a, const PooledTrials& b) {
        return a.strength < b.strength || (a.strength == b.strength && a.correct < b.correct);
    });
    size_t kept = 0;
    for (size_t k = 1; k < trials.size(); ++k) {
        if (trials[k].strength == trials[kept].strength && trials[k].correct == trials[kept].correct) {
            trials[kept].count += trials[k].count;
        } else {
            trials[++kept] = trials[k];
        }
    }
    if (!trials.empty()) trials.resize(kept + 1);
    return trials;
}

void add_log_likelihood(std::vector<double>& log_likelihood, const std::vector<PooledTrials>& pooled, size_t stride,
                        const LocationGrid& grid, double beta, const std::vector<double>& deltas) {
    const SeenTable seen(grid, beta);
    const size_t points = grid.points;
    std::vector<double> e(points);
    std::vector<double> product(points * deltas.size(), 1.0);
    const auto multiply_all = [&](const PooledTrials& trial) {
        seen.fill(e, trial.strength);
        for (size_t d = 0; d < deltas.size(); ++d) {
            const double blind = (1 - kGuessRate) * deltas[d];
            const double aware = (1 - kGuessRate) * (1 - deltas[d]);
            if (trial.correct) {
                multiply(&product[d * points], e.data(), points, 1 - blind, -aware);
            } else {
                multiply(&product[d * points], e.data(), points, blind, aware);
            }
        }
    };
    int factors = 0;
    for (size_t k = 0; k < pooled.size(); k += stride) {
        if (pooled[k].count != 1) continue;
        multiply_all(pooled[k]);
        if (++factors % kFactorsALogarithm == 0) {
            take_logarithm(log_likelihood.data(), product.data(), product.size(), 1);
        }
    }
    take_logarithm(log_likelihood.data(), product.data(), product.size(), 1);
    for (size_t k = 0; k < pooled.size(); k += stride) {
        if (pooled[k].count == 1) continue;
        multiply_all(pooled[k]);
        take_logarithm(log_likelihood.data(), product.data(), product.size(), pooled[k].count);
    }
}

void add_overdispersed_log_likelihood(std::vector<double>& log_likelihood, const std::vector<PooledTrials>& pooled,
                                      size_t stride, const LocationGrid& grid, double beta,
                                      const std::vector<double>& deltas, double eta) {
    const SeenTable seen(grid, beta);
    std::vector<double> e(grid.points);
    for (size_t k = 0; k < pooled.size(); k += stride) {
        const PooledTrials& first = pooled[k];
        // Sorted: the wrong answers at a strength stand before the right ones.
        const bool both = k + 1 < pooled.size() && pooled[k + 1].strength == first.strength && stride == 1;
        const double wrong = first.correct ? 0 : first.count;
        const double right = first.correct ? first.count : both ? pooled[k + 1].count : 0;
        seen.fill(e, first.strength);
        for (size_t d = 0; d < deltas.size(); ++d) {
            for (size_t i = 0; i < grid.points; ++i) {
                const double psi = 1 - (1 - kGuessRate) * (deltas[d] + (1 - deltas[d]) * e[i]);
                log_likelihood[d * grid.points + i] += beta_binomial_log_likelihood(right, wrong, psi, eta);
            }
        }
        if (both) ++k;
    }
}

std::vector<double> location_log_likelihood(const std::vector<PooledTrials>& pooled, double beta, double delta,
                                            const LocationGrid& grid) {
    std::vector<double> log_likelihood(grid.points);
    add_log_likelihood(log_likelihood, pooled, 1, grid, beta, {delta});
    return log_likelihood;
}

}  // namespace stairstep
