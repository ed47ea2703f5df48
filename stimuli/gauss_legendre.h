// Gauss's quadrature: ∫ f dx ≈ Σ weight·f(node), exact for polynomials of degree 2·count − 1.
//
// Anchor: 6 nodes on [−1, 3] integrate x¹¹ exactly.
#pragma once

#include <cstddef>
#include <vector>

namespace stairstep {

struct QuadratureRule {
    std::vector<double> nodes;
    std::vector<double> weights;
};

/// The rule of `count` ≥ 1 nodes on [low, high] (Legendre), by Newton's method.
QuadratureRule gauss_legendre(size_t count, double low, double high);

}  // namespace stairstep
