#include "analysis/overdispersion.h"

#include <cassert>
#include <cmath>

namespace stairstep {
namespace {

/// Up to so many factors a product is faster than three Γ functions, and keeps its digits where ν is large.
constexpr double kFewAnswers = 64;
/// Below, the answers count as independent: ν beyond 10⁶ changes nothing in blocks of thousands.
constexpr double kLeastEta = 1e-3;

/// ln Π_{j<n} (a + j)/ν.
double log_rising(double a, double n, double nu) {
    if (n > kFewAnswers) return std::lgamma(a + n) - std::lgamma(a) - n * std::log(nu);
    double sum = 0;
    double product = 1;
    for (double j = 0; j < n; ++j) {
        product *= (a + j) / nu;
        if (product < 1e-100 || product > 1e100) {
            sum += std::log(product);
            product = 1;
        }
    }
    return sum + std::log(product);
}

}  // namespace

double beta_binomial_log_likelihood(double right, double wrong, double psi, double eta) {
    assert(psi > 0 && psi < 1 && eta >= 0 && eta < 1);
    if (eta < kLeastEta) {
        return (right > 0 ? right * std::log(psi) : 0) + (wrong > 0 ? wrong * std::log1p(-psi) : 0);
    }
    const double nu = 1 / (eta * eta) - 1;
    return log_rising(psi * nu, right, nu) + log_rising((1 - psi) * nu, wrong, nu) - log_rising(nu, right + wrong, nu);
}

double log_overdispersion_prior(double eta) {
    return std::log(10.0) + 9 * std::log1p(-eta);
}

}  // namespace stairstep
