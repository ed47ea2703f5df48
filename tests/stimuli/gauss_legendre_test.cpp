#include "stimuli/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stairstep {
namespace {

TEST(GaussLegendre, IntegratesPolynomials) {
    const QuadratureRule rule = gauss_legendre(6, -1, 3);
    double sum = 0;
    for (size_t i = 0; i < rule.nodes.size(); ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], 11);
    EXPECT_NEAR(sum, (std::pow(3.0, 12) - 1) / 12, 1e-8);
}

}  // namespace
}  // namespace stairstep
